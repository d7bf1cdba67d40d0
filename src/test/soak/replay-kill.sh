#!/usr/bin/env bash
# Kills the task manager of the job replay while its replays are steered, and moves it once; no epoch may have a gap.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/kafka.sh
. "$soak/parts/kafka.sh"
# shellcheck source=parts/build.sh
. "$soak/parts/build.sh"
# shellcheck source=parts/flink.sh
. "$soak/parts/flink.sh"

rounds=1
kills=10
longest=6
replays=4
deliveries="at-least-once exactly-once"
plant=none
seed=$RANDOM

usage() {
    cat <<USAGE
Usage: ./furrow soak replay-kill [OPTION VALUE]…
Runs the job replay on a standalone Flink $flink_version beside a Kafka broker and the stand-in for MongoDB, all started for this.
Replays of missions of 2,000 numbered events, played over and over, are paused, resumed, sought, stepped forth and back and set to
other speeds at random. Meanwhile kill -9 ends the task manager at random moments, and another is started at once; halfway the job
is stopped with a savepoint and goes on at another parallelism. In the end all replays are stopped. Then the sequences of each
epoch on each topic must have no gap; with exactly-once each is there once, the events are consecutive ones of the mission, and each epoch
ends once on every partition. FLINK_HOME names a distribution; without it one is fetched once, some 315 MB.

  --rounds N     Of each kind of delivery. Default: $rounds.
  --kills N      In a round. Default: $kills.
  --longest N    Seconds; before each kill is a random time up to this. Default: $longest.
  --replays N    Default: $replays.
  --delivery D   at-least-once or exactly-once. Default: both.
  --plant F      lost or doubled: lets the check overlook an event, or see it twice, which it must find.
  --seed N       Of the random moments and commands. Default: another each time; it is printed.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --rounds) rounds=${2-} ;;
        --kills) kills=${2-} ;;
        --longest) longest=${2-} ;;
        --replays) replays=${2-} ;;
        --delivery) deliveries=${2-} ;;
        --plant) plant=${2-} ;;
        --seed) seed=${2-} ;;
        *) fail "replay-kill knows no option $1. See: ./furrow soak replay-kill --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak replay-kill --help"
    shift 2
done
[[ $rounds =~ ^[1-9][0-9]*$ ]] || fail "--rounds must be a whole number from 1, not '$rounds'."
[[ $kills =~ ^[1-9][0-9]*$ ]] || fail "--kills must be a whole number from 1, not '$kills'."
[[ $longest =~ ^[1-9][0-9]*$ ]] || fail "--longest must be a whole number from 1, not '$longest'."
[[ $replays =~ ^[1-9][0-9]*$ ]] || fail "--replays must be a whole number from 1, not '$replays'."
[[ $deliveries =~ ^(at-least-once|exactly-once|at-least-once exactly-once)$ ]] ||
    fail "--delivery must be at-least-once or exactly-once, not '$deliveries'."
[[ $plant =~ ^(none|lost|doubled)$ ]] || fail "--plant must be lost or doubled, not '$plant'."
[[ $seed =~ ^[0-9]+$ ]] || fail "--seed must be a whole number, not '$seed'."
[[ $plant != doubled || $deliveries == exactly-once ]] || fail "--plant doubled is not a fault unless --delivery is exactly-once."
command -v curl >/dev/null || fail "No curl found, which asks Flink whether it is ready. Install curl."

base=$(mktemp -d "${TMPDIR:-/tmp}/furrow-replay-kill.XXXXXX")
all_logs=$home/target/soak/replay-kill
logs=$all_logs
classes=$home/src/target/test-classes:$home/suite/launcher/target/furrow/lib/*

clean_up() {
    local code=$?
    trap - EXIT INT TERM
    stop_own
    rm -rf "$base" "${making:-}"
    case $code in
        0) ;;
        130 | 143) echo "replay-kill: interrupted" ;;
        *) printf 'replay-kill: failed; logs: %s\n' "$all_logs" ;;
    esac
    exit "$code"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
rm -rf "$all_logs"
mkdir -p "$all_logs"

# begin NAME: broker, stand-in and cluster, below folders of that name.
begin() {
    run=$base/$1
    logs=$all_logs/$1
    mkdir -p "$run" "$logs"
    start_kafka
    local port
    free_port && mongo=mongodb://127.0.0.1:$port
    "$java" -Xmx384m -Dfurrow.log="$logs/mongo.log" -cp "$classes" io.furrow.soak.ingest.MongoStandIn "$run/mongo" "$port" \
        >"$logs/mongo.out" 2>&1 &
    own $!
    until_true 30 "The stand-in for MongoDB" open_port "$port"
    # A task manager that was killed says nothing: it is to be missed sooner than after 50 s.
    start_flink "heartbeat.interval: 1000" "heartbeat.timeout: 8000"
    say "$1: Kafka at $bootstrap, MongoDB at $mongo, Flink at $rest"
}

# steer SEED: in the background, until $run/enough is there; sets steering.
steer() {
    "$java" -Xmx256m -Dfurrow.log="$logs/steering.log" -cp "$classes" io.furrow.soak.replay.ReplaySteering \
        "$bootstrap" "$mongo" "$replays" "$1" "$run/enough" >"$logs/steering.out" 2>&1 &
    steering=$!
    own "$steering"
    until_true 60 "The replays" grep -q '^steering' "$logs/steering.out"
}

# run_job DELIVERY PARALLELISM [FLINK-OPTION…]: sets job.
run_job() {
    local delivery=$1 parallelism=$2
    shift 2
    "$FLINK_HOME/bin/flink" run -d "$@" "$(ls "$home"/replay/target/furrow-replay-*-job.jar)" replay \
        --bootstrap-servers "$bootstrap" --delivery "$delivery" --mongo "$mongo" --checkpoint-interval 1s \
        --restart-delay 500ms --restart-delay-max 2s --page-events 200 --parallelism "$parallelism" >"$logs/run.out" 2>&1 ||
        { tail -n 5 "$logs/run.out" >&2; fail "flink run of replay failed."; }
    job=$(sed -n 's/.*submitted with JobID \([0-9a-f]*\).*/\1/p' "$logs/run.out")
    until_true 60 "The running job" is_running
}

is_running() { curl -fs "$rest/jobs/$job" | grep -q '"state":"RUNNING"'; }

# count_of STATE: of the job's checkpoints.
count_of() { curl -fs "$rest/jobs/$job/checkpoints" | sed -n "s/.*\"counts\":{[^}]*\"$1\":\([0-9]*\).*/\1/p"; }
has_completed_another() { (($(count_of completed) > completed)); }

# Fails while the job is restarted after a kill.
stop_with_savepoint() { "$FLINK_HOME/bin/flink" stop --savepointPath "file://$run/savepoints" "$job" >"$logs/stop.out" 2>&1; }

# move DELIVERY PARALLELISM: stops the job with a savepoint, and goes on from it.
move() {
    until_true 180 "A savepoint" stop_with_savepoint
    local savepoint
    savepoint=$(sed -n 's/.*Savepoint completed. Path: //p' "$logs/stop.out")
    restored=$((restored + $(count_of restored)))
    run_job "$1" "$2" -s "$savepoint"
    say "stopped with a savepoint, continued with parallelism $2"
}

# kill_at_random_moments DELIVERY
kill_at_random_moments() {
    local number pause
    restored=0
    for ((number = 1; number <= kills; number++)); do
        pause=${pauses[number - 1]}
        completed=$(count_of completed)
        ((number % 3 == 0)) || until_true 180 "A checkpoint after kill $((number - 1))" has_completed_another
        sleep "$((pause / 1000)).$(printf %03d $((pause % 1000)))"
        kill -9 "$task_manager"
        wait "$task_manager" 2>/dev/null || true
        start_task_manager
        say "kill $number, after $pause ms; $((restored + $(count_of restored))) times restored"
        ((number != (kills + 1) / 2)) || move "$1" 3
    done
    completed=$(count_of completed)
    until_true 180 "A checkpoint after the last kill" has_completed_another
    restored=$((restored + $(count_of restored)))
}

# round NUMBER DELIVERY
round() {
    local i failed=
    begin "$1-$2"
    pauses=()
    for ((i = 0; i < kills; i++)); do pauses+=($((RANDOM % (longest * 1000)))); done
    steer $((seed + $1))
    run_job "$2" 2
    kill_at_random_moments "$2"
    touch "$run/enough"
    wait "$steering" || { tail -n 5 "$logs/steering.out" >&2; fail "Not all replays were stopped."; }
    say "$(grep '^steered' "$logs/steering.out"), $restored times restored"
    "$java" -Xmx1g -Dfurrow.log="$logs/check.log" -cp "$classes" io.furrow.soak.replay.PlayedTopics \
        "$bootstrap" "$2" "$replays" "$plant" "$seed" | tee "$logs/check" || failed=yes
    stop_own
    [[ -z $failed ]] || fail "What the topics hold is wrong, as said above; seed $seed."
    ((restored >= kills / 2)) || fail "Only $restored times the job went on from a checkpoint: the machine is too slow for --longest $longest."
}

build_soaks system-tests
provide_flink
RANDOM=$seed
say "seed $seed, before each kill at most $longest s"
for ((number = 1; number <= rounds; number++)); do
    for delivery in $deliveries; do round "$number" "$delivery"; done
done
echo "replay-kill: passed"
