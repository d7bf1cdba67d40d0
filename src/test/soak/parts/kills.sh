# Kills the task manager of a job on Flink at random moments. Sourced after machine.sh, kafka.sh and flink.sh, not run.
# shellcheck shell=bash disable=SC2154 # home, java, kills, longest and job come from the soak

# Prepares; each call of begin uses folders below those of the soak.
prepare_kills() {
    prepare
    base=$run
    all_logs=$logs
    classes=$home/src/target/test-classes:$home/suite/launcher/target/furrow/lib/*
}

# begin NAME: starts broker, stand-in and cluster, with folders of that name.
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
    # Detects a killed task manager sooner than after the default of 50 s.
    start_flink "heartbeat.interval: 1000" "heartbeat.timeout: 8000"
    say "$1: Kafka at $bootstrap, MongoDB at $mongo, Flink at $rest"
}

# Sets pauses to the random times before each kill, ms.
choose_pauses() {
    local i
    pauses=()
    for ((i = 0; i < kills; i++)); do pauses+=($((RANDOM % (longest * 1000)))); done
}

# kill_task_manager NUMBER: kills and replaces it after its pause; two of three times only after another checkpoint.
kill_task_manager() {
    local pause=${pauses[$1 - 1]}
    completed=$(count_of completed)
    (($1 % 3 == 0)) || until_true 180 "A checkpoint after kill $(($1 - 1))" has_completed_another
    sleep "$((pause / 1000)).$(printf %03d $((pause % 1000)))"
    kill -9 "$task_manager"
    wait "$task_manager" 2>/dev/null || true
    start_task_manager
}

is_running() { curl -fs "$rest/jobs/$job" | grep -q '"state":"RUNNING"'; }

# count_of STATE: number of the job's checkpoints in that state.
count_of() { curl -fs "$rest/jobs/$job/checkpoints" | sed -n "s/.*\"counts\":{[^}]*\"$1\":\([0-9]*\).*/\1/p"; }
has_completed_another() { (($(count_of completed) > completed)); }
