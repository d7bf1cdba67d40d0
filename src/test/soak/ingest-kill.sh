#!/usr/bin/env bash
# Kills the task manager of the job ingest repeatedly under load; its output must equal that of an undisturbed run.
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

kills=10
rate=500
longest=10
state_backend=hashmap
seed=$RANDOM

usage() {
    cat <<USAGE
Usage: ./furrow soak ingest-kill [OPTION VALUE]…
Starts a Kafka broker, a stand-in for MongoDB and a standalone Flink $flink_version, and runs ingest with exactly-once delivery, MongoDB and
images. While records are written, the task manager is killed (kill -9) at random moments and replaced at once: two of three times after
the job has been restored and has completed a checkpoint, the third time at any moment. A second run processes the same records without
kills. All topics (committed records), collections and files must be equal. Uses the Flink of FLINK_HOME, or fetches one once (some
315 MB).

  --kills N          Kills. Default: $kills.
  --rate N           Records per second. Default: $rate.
  --longest N        Maximum of the random time before each kill, in seconds. Default: $longest.
  --state-backend N  hashmap or rocksdb. Default: $state_backend.
  --seed N           Seed of the random moments. Default: random; it is printed.
USAGE
}

read_options "kills rate longest state-backend seed" "$@"
check_numbers 1 kills rate longest
check_choice state-backend hashmap rocksdb
check_numbers 0 seed
command -v curl >/dev/null || fail "curl is missing, which probes Flink. Install curl."

prepare_kills

# load RATE ENOUGH: writes records in the background; sets load to the process.
load() {
    "$java" -Xmx256m -Dfurrow.log="$logs/load.log" -cp "$classes" io.furrow.soak.ingest.LoadWriter "$bootstrap" "$1" "$2" \
        >"$logs/load.out" 2>&1 &
    load=$!
    own "$load"
    until_true 30 "The topic data.raw" grep -q '^writing' "$logs/load.out"
}

# An idle source does not emit the last watermark of --drain (FLINK-40499), hence the long idle timeout.
run_job() {
    "$FLINK_HOME/bin/flink" run -d "$(ls "$home"/ingest/target/furrow-ingest-*-job.jar)" ingest \
        --bootstrap-servers "$bootstrap" --delivery exactly-once --mongo "$mongo" --images "file://$run/images" \
        --checkpoint-interval 2s --restart-delay 500ms --restart-delay-max 2s --topic-retention 36500d \
        --idle-timeout 1h --state-backend "$state_backend" --parallelism 2 >"$logs/run.out" 2>&1 ||
        { tail -n 5 "$logs/run.out" >&2; fail "flink run of ingest failed."; }
    job=$(sed -n 's/.*submitted with JobID \([0-9a-f]*\).*/\1/p' "$logs/run.out")
}

# Waits for the end of the load, drains the job, and writes its output to $run/outcome.
finish() {
    wait "$load" || { tail -n 5 "$logs/load.out" >&2; fail "The job did not emit all records."; }
    say "$(grep '^wrote' "$logs/load.out"), $(grep '^all read' "$logs/load.out")"
    restored=$(count_of restored)
    say "checkpoints: $(count_of completed) completed, $restored times restored"
    "$FLINK_HOME/bin/flink" stop --drain --savepointPath "file://$run/savepoints" "$job" >"$logs/stop.out" 2>&1 ||
        { tail -n 5 "$logs/stop.out" >&2; fail "flink stop of ingest failed."; }
    "$java" -Xmx1g -Dfurrow.log="$logs/outcome.log" -cp "$classes" io.furrow.soak.ingest.IngestOutcome \
        "$bootstrap" "$mongo" "$run/images" "$run/outcome" | tee "$logs/outcome"
    stop_own
}

kill_at_random_moments() {
    local number
    for ((number = 1; number <= kills; number++)); do
        kill_task_manager "$number"
        say "kill $number; $(count_of restored) times restored"
    done
}

build_soaks
provide_flink
RANDOM=$seed
choose_pauses
say "seed $seed, before each kill at most $longest s"

# Both names have the same length: events contain paths of images, and the catalog counts the bytes of events.
begin disturbed
load "$rate" "$run/enough"
run_job
until_true 60 "The running job" is_running
kill_at_random_moments
touch "$run/enough"
finish
((restored >= kills / 2)) || fail "The job was restored from a checkpoint only $restored times: the machine is too slow for --longest $longest."
records=$(tail -n 1 "$logs/load.out")

begin faultless
load 0 "$records"
run_job
finish

if ! cmp -s "$base/disturbed/outcome" "$base/faultless/outcome"; then
    diff "$base/faultless/outcome" "$base/disturbed/outcome" >"$all_logs/differences" || true
    cut -c1-300 "$all_logs/differences" | head -n 20
    fail "The output of the killed job differs from that of the undisturbed one: $(grep -c '^[<>]' "$all_logs/differences") lines, $all_logs/differences"
fi
say "$(wc -l <"$base/faultless/outcome") lines, equal after $kills kills"
echo "ingest-kill: passed"
