#!/usr/bin/env bash
# Kills the task manager of the job replay while replays are controlled, and restores it once at another parallelism; no epoch may have a gap.
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
# shellcheck source=parts/kills.sh
. "$soak/parts/kills.sh"

rounds=1
kills=10
longest=6
replays=4
delivery=
plant=none
seed=$RANDOM

usage() {
    cat <<USAGE
Usage: ./furrow soak replay-kill [OPTION VALUE]…
Starts a Kafka broker, a stand-in for MongoDB and a standalone Flink $flink_version with the job replay. Replays of missions of 2,000
numbered events are repeated, and paused, resumed, sought, stepped in both directions and set to other speeds at random. Meanwhile the
task manager is killed (kill -9) at random moments and replaced at once. Halfway, the job is stopped with a savepoint and restored at
another parallelism. At the end all replays are stopped. The sequences of each epoch on each topic must then have no gap. With
exactly-once, each sequence must be there once, the events must be consecutive in the mission, and each epoch must end once on every
partition. Uses the Flink of FLINK_HOME, or fetches one once (some 315 MB).

  --rounds N     Rounds per kind of delivery. Default: $rounds.
  --kills N      Kills per round. Default: $kills.
  --longest N    Maximum of the random time before each kill, in seconds. Default: $longest.
  --replays N    Concurrent replays. Default: $replays.
  --delivery D   at-least-once or exactly-once. Default: both.
  --plant F      Plants a fault that the check must find: lost (an event is skipped) or doubled (an event is read twice).
  --seed N       Seed of the random moments and commands. Default: random; it is printed.
USAGE
}

read_options "rounds kills longest replays delivery plant seed" "$@"
check_numbers 1 rounds kills longest replays
[[ -z $delivery ]] || check_choice delivery at-least-once exactly-once
deliveries=${delivery:-at-least-once exactly-once}
check_choice plant none lost doubled
check_numbers 0 seed
[[ $plant != doubled || $deliveries == exactly-once ]] || fail "--plant doubled is not a fault unless --delivery is exactly-once."
command -v curl >/dev/null || fail "curl is missing, which probes Flink. Install curl."

prepare_kills

# steer SEED: controls replays in the background until $run/enough exists; sets steering to the process.
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

# Fails while the job is restarted after a kill.
stop_with_savepoint() { "$FLINK_HOME/bin/flink" stop --savepointPath "file://$run/savepoints" "$job" >"$logs/stop.out" 2>&1; }

# move DELIVERY PARALLELISM: stops the job with a savepoint and restores it from there.
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
    local number
    restored=0
    for ((number = 1; number <= kills; number++)); do
        kill_task_manager "$number"
        say "kill $number; $((restored + $(count_of restored))) times restored"
        ((number != (kills + 1) / 2)) || move "$1" 3
    done
    completed=$(count_of completed)
    until_true 180 "A checkpoint after the last kill" has_completed_another
    restored=$((restored + $(count_of restored)))
}

# round NUMBER DELIVERY
round() {
    local failed=
    begin "$1-$2"
    choose_pauses
    steer $((seed + $1))
    run_job "$2" 2
    kill_at_random_moments "$2"
    touch "$run/enough"
    wait "$steering" || { tail -n 5 "$logs/steering.out" >&2; fail "Cannot stop all replays."; }
    say "$(grep '^steered' "$logs/steering.out"), $restored times restored"
    "$java" -Xmx1g -Dfurrow.log="$logs/check.log" -cp "$classes" io.furrow.soak.replay.PlayedTopics \
        "$bootstrap" "$2" "$replays" "$plant" "$seed" | tee "$logs/check" || failed=yes
    stop_own
    [[ -z $failed ]] || fail "The topics have the faults listed above; seed $seed."
    ((restored >= kills / 2)) || fail "The job was restored from a checkpoint only $restored times: the machine is too slow for --longest $longest."
}

build_soaks
provide_flink
RANDOM=$seed
say "seed $seed, before each kill at most $longest s"
for ((number = 1; number <= rounds; number++)); do
    for delivery in $deliveries; do round "$number" "$delivery"; done
done
echo "replay-kill: passed"
