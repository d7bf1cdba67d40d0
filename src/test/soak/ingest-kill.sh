#!/usr/bin/env bash
# Kills the task manager of the job ingest under load, again and again; all it leaves must be as without.
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

kills=10
rate=500
longest=10
backend=hashmap
seed=$RANDOM

usage() {
    cat <<USAGE
Usage: ./furrow soak ingest-kill [OPTION VALUE]…
Runs ingest, exactly-once, with MongoDB and images, on a standalone Flink $flink_version beside a Kafka broker and the stand-in for
MongoDB, all started for this. While records come in, kill -9 ends the task manager at random moments, and another is
started at once; two of three kills hit a job that has come back and completed a checkpoint, the third whatever it does. Then the same records go through a run without kills, and all topics (committed records), collections and
files must be equal. FLINK_HOME names a distribution; without it one is fetched once, some 315 MB.

  --kills N          Default: $kills.
  --rate N           Records per second. Default: $rate.
  --longest N        Seconds; before each kill is a random time up to this. Default: $longest.
  --state-backend N  hashmap or rocksdb. Default: $backend.
  --seed N           Of the random moments. Default: another each time; it is printed.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --kills) kills=${2-} ;;
        --rate) rate=${2-} ;;
        --longest) longest=${2-} ;;
        --state-backend) backend=${2-} ;;
        --seed) seed=${2-} ;;
        *) fail "ingest-kill knows no option $1. See: ./furrow soak ingest-kill --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak ingest-kill --help"
    shift 2
done
[[ $kills =~ ^[1-9][0-9]*$ ]] || fail "--kills must be a whole number from 1, not '$kills'."
[[ $rate =~ ^[1-9][0-9]*$ ]] || fail "--rate must be a whole number from 1, not '$rate'."
[[ $longest =~ ^[1-9][0-9]*$ ]] || fail "--longest must be a whole number from 1, not '$longest'."
[[ $backend == hashmap || $backend == rocksdb ]] || fail "--state-backend must be hashmap or rocksdb, not '$backend'."
[[ $seed =~ ^[0-9]+$ ]] || fail "--seed must be a whole number, not '$seed'."
command -v curl >/dev/null || fail "No curl found, which asks Flink whether it is ready. Install curl."

base=$(mktemp -d "${TMPDIR:-/tmp}/furrow-ingest-kill.XXXXXX")
all_logs=$home/target/soak/ingest-kill
logs=$all_logs
classes=$home/src/target/test-classes:$home/suite/launcher/target/furrow/lib/*

clean_up() {
    local code=$?
    trap - EXIT INT TERM
    stop_own
    rm -rf "$base" "${making:-}"
    case $code in
        0) ;;
        130 | 143) echo "ingest-kill: interrupted" ;;
        *) printf 'ingest-kill: failed; logs: %s\n' "$all_logs" ;;
    esac
    exit "$code"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
rm -rf "$all_logs"
mkdir -p "$all_logs"

# begin NAME: broker, stand-in, cluster, and the job on them, below folders of that name.
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

# load RATE ENOUGH: writes in the background; sets load.
load() {
    "$java" -Xmx256m -Dfurrow.log="$logs/load.log" -cp "$classes" io.furrow.soak.ingest.LoadWriter "$bootstrap" "$1" "$2" \
        >"$logs/load.out" 2>&1 &
    load=$!
    own "$load"
    until_true 30 "The topic data.raw" grep -q '^writing' "$logs/load.out"
}

# The end of event time, which --drain tells, does not leave a source that is idle (FLINK-40499): none is.
run_job() {
    "$FLINK_HOME/bin/flink" run -d "$(ls "$home"/ingest/target/furrow-ingest-*-job.jar)" ingest \
        --bootstrap-servers "$bootstrap" --delivery exactly-once --mongo "$mongo" --images "file://$run/images" \
        --checkpoint-interval 2s --restart-delay 500ms --restart-delay-max 2s --topic-retention 36500d \
        --idle-timeout 1h --state-backend "$backend" --parallelism 2 >"$logs/run.out" 2>&1 ||
        { tail -n 5 "$logs/run.out" >&2; fail "flink run of ingest failed."; }
    job=$(sed -n 's/.*submitted with JobID \([0-9a-f]*\).*/\1/p' "$logs/run.out")
}

is_running() { curl -fs "$rest/jobs/$job" | grep -q '"state":"RUNNING"'; }

# count_of STATE: of the job's checkpoints.
count_of() { curl -fs "$rest/jobs/$job/checkpoints" | sed -n "s/.*\"counts\":{[^}]*\"$1\":\([0-9]*\).*/\1/p"; }
has_completed_another() { (($(count_of completed) > completed)); }

# Waits for the end of the load, drains the job, and writes down what there is.
finish() {
    wait "$load" || { tail -n 5 "$logs/load.out" >&2; fail "Not all came out of the job."; }
    say "$(grep '^wrote' "$logs/load.out"), $(grep '^all read' "$logs/load.out")"
    restored=$(count_of restored)
    say "checkpoints: $(count_of completed) completed, $restored times restored"
    "$FLINK_HOME/bin/flink" stop --drain --savepointPath "file://$run/savepoints" "$job" >"$logs/stop.out" 2>&1 ||
        { tail -n 5 "$logs/stop.out" >&2; fail "flink stop of ingest failed."; }
    "$java" -Xmx1g -Dfurrow.log="$logs/outcome.log" -cp "$classes" io.furrow.soak.ingest.Outcome \
        "$bootstrap" "$mongo" "$run/images" "$run/outcome" | tee "$logs/outcome"
    stop_own
}

kill_at_random_moments() {
    local number pause
    for ((number = 1; number <= kills; number++)); do
        pause=${pauses[number - 1]}
        completed=$(count_of completed)
        ((number % 3 == 0)) || until_true 180 "A checkpoint after kill $((number - 1))" has_completed_another
        sleep "$((pause / 1000)).$(printf %03d $((pause % 1000)))"
        kill -9 "$task_manager"
        wait "$task_manager" 2>/dev/null || true
        start_task_manager
        say "kill $number, after $pause ms; $(count_of restored) times restored"
    done
}

build_soaks system-tests
provide_flink
RANDOM=$seed
pauses=()
for ((i = 0; i < kills; i++)); do pauses+=($((RANDOM % (longest * 1000)))); done
say "seed $seed, before each kill at most $longest s"

# Names of one length: the catalog counts the bytes of events, in which is where images are.
begin disturbed
load "$rate" "$run/enough"
run_job
until_true 60 "The running job" is_running
kill_at_random_moments
touch "$run/enough"
finish
((restored >= kills / 2)) || fail "Only $restored times the job went on from a checkpoint: the machine is too slow for --longest $longest."
records=$(tail -n 1 "$logs/load.out")

begin faultless
load 0 "$records"
run_job
finish

if ! cmp -s "$base/disturbed/outcome" "$base/faultless/outcome"; then
    diff "$base/faultless/outcome" "$base/disturbed/outcome" >"$all_logs/differences" || true
    cut -c1-300 "$all_logs/differences" | head -n 20
    fail "What the killed job left differs from what the other left: $(grep -c '^[<>]' "$all_logs/differences") lines, $all_logs/differences"
fi
say "$(wc -l <"$base/faultless/outcome") lines, equal after $kills kills"
echo "ingest-kill: passed"
