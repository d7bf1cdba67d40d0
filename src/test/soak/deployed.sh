#!/usr/bin/env bash
# Runs the archive's programs as separate processes, as docker/compose.yaml starts them: a mission, its results, its replay.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/flink.sh
. "$soak/parts/flink.sh"

usage() {
    cat <<USAGE
Usage: ./furrow soak deployed
Unpacks suite/distribution/target/furrow-*.tar.gz (built by ./mvnw package -Prelease -DskipTests) and runs the services of its
docker/compose.yaml without containers: Kafka, two Connect workers, Mosquitto, a Flink cluster, the jobs by flink run, two control planes,
simulated devices, the dashboard. Commands, options, connectors and settings are those of the file, with other hosts, ports and folders.
Stand-ins replace Orion, the IoT Agent and MongoDB, a folder replaces HDFS. Both workers share the disk of the journal.
Under a load, both workers, a task manager and a control plane are killed, and two jobs are stopped with a savepoint and submitted again. No
message may be lost, and none duplicated except after the kill of the task manager. A proxy retries unanswered notifications, which Orion
does not do, so that any missing message was acknowledged. Uses the Flink $flink_version of FLINK_HOME, or fetches one once (some 315 MB).
USAGE
}

read_options "" "$@"
command -v python3 >/dev/null || fail "Python 3 is missing. Install python3."
[[ -x /usr/sbin/mosquitto ]] || command -v mosquitto >/dev/null || fail "Mosquitto is missing. Install the packages mosquitto and mosquitto-clients."

prepare
mkdir "$run/accounts" "$run/mosquitto-data" "$run/mosquitto-log"

tar xzf "$home"/suite/distribution/target/furrow-*.tar.gz -C "$run"
archive=$(echo "$run"/furrow-*)
# As the Dockerfile does.
(cd "$archive/jobs" && for job in ingest analytics replay; do mv furrow-$job-*-job.jar $job.jar; done)
"$archive/bin/furrow" init "$run/secrets" >/dev/null
class_path=$(sed "s|^|$archive/lib/|" "$archive/lib/class-path" | paste -sd:)
test_path=$home/src/target/test-classes:$class_path
snakeyaml=$(find "${MAVEN_REPOSITORY:-$HOME/.m2/repository}/org/yaml/snakeyaml" -name 'snakeyaml-*.jar' | sort -V | tail -n 1)

for name in kafka controller mqtt orion agent mongo notify retries worker1 worker2 control health control2 health2 dashboard metrics; do
    free_port
    declare "$name=$port"
done

# Replaces hosts, ports and folders in the compose file and the files beside it.
here() {
    sed -e "s|kafka:9092|127.0.0.1:$kafka|g; s|://:9092|://127.0.0.1:$kafka|g; s|kafka:9093|127.0.0.1:$controller|g; s|://:9093|://127.0.0.1:$controller|g" \
        -e "s|mosquitto:1883|127.0.0.1:$mqtt|g; s|orion:1026|127.0.0.1:$orion|g; s|iot-agent:4041|127.0.0.1:$agent|g" \
        -e "s|hdfs://namenode:8020|file://$run/hdfs|g" \
        -e "s|control-plane:8085|127.0.0.1:$control|g; s|jobmanager:8081|${rest:-127.0.0.1}|g; s|http://http|http|g" \
        -e "s|connect:8083|127.0.0.1:$worker1|g; s|connect:{port}|127.0.0.1:$retries/127.0.0.1:{port}|g; s|0\.0\.0\.0|127.0.0.1|g; s|\"8090\"|\"$notify\"|g" \
        -e "s|9249-9250|$metrics-$((metrics + 9))|g" \
        -e "s|/opt/furrow|$archive|g; s|/run/secrets|$run/secrets|g; s|/mosquitto/config|$run/accounts|g; s|/mosquitto/data|$run/mosquitto-data|g; s|/mosquitto/log|$run/mosquitto-log|g" \
        -e "s|/var/lib/furrow/journal|$run/journal|g; s|/var/lib/kafka/data|$run/kafka|g; s#/connectors/\(ngsi-[a-z]*\.json\)#$run/\1#g"
}

# words SERVICE PART: reads a part of the service into the array words.
words() {
    local text
    text=$("$java" -Xmx128m -cp "$test_path:$snakeyaml" io.furrow.deployment.ComposeCommand "$archive/docker/compose.yaml" "$1" "$2" | here)
    mapfile -t words <<<"$text"
}

# start NAME COMMAND…: starts a command in the background, to be stopped at the end.
start() {
    local name=$1
    shift
    "$@" >"$logs/$name.log" 2>&1 &
    own $!
}

say "Mosquitto, Kafka, stand-ins"
echo "mongodb://127.0.0.1:$mongo" >"$run/secrets/mongo/uri"
here <"$archive/docker/mosquitto/mosquitto.conf" | sed "s|listener 1883|listener $mqtt 127.0.0.1\nuser $(id -un)|" >"$run/mosquitto.conf"
XDG_CONFIG_HOME=$run PATH=$PATH:/usr/sbin start mosquitto "$archive/docker/mosquitto/run" "$run/mosquitto.conf" "$run/accounts" "$run/secrets/mqtt/password"

words kafka environment
# The image of Kafka derives its properties in the same way.
printf '%s\n' "${words[@]}" | sed -n 's/^KAFKA_\([A-Z_]*\)=/\1=/p' | while IFS='=' read -r name value; do
    name=${name,,}
    printf '%s=%s\n' "${name//_/.}" "$value"
done | sed 's|,HOST:[^,]*||; /^heap/d' >"$run/kafka.properties"
"$java" -cp "$class_path" kafka.tools.StorageTool format -t "$("$java" -cp "$class_path" kafka.tools.StorageTool random-uuid)" \
    -c "$run/kafka.properties" >"$logs/kafka-format.log" 2>&1
start kafka "$java" -Xmx512m -Dfurrow.log="$logs/kafka.log" -cp "$class_path" kafka.Kafka "$run/kafka.properties"
until_true 60 "Kafka" open_port "$kafka"
until_true 60 "Mosquitto" open_port "$mqtt"
start stand-ins "$java" -Xmx512m -cp "$test_path" io.furrow.deployment.StandIns "$run/mongo" "$orion" "$agent" "$mongo" "$retries" "tcp://127.0.0.1:$mqtt" iot-agent "$(cat "$run/secrets/mqtt/password")" "127.0.0.1:$kafka"
until_true 60 "The context broker's stand-in" open_port "$orion"

# start_worker NUMBER: sets worker_NUMBER to its process.
start_worker() {
    start "connect-$1" "$java" -Xmx512m -Dfurrow.log="$logs/connect-$1.log" -cp "$class_path" org.apache.kafka.connect.cli.ConnectDistributed "$run/connect-$1.properties"
    declare -g "worker_$1=$!"
}

say "two Connect workers and the connectors"
for worker in 1 2; do
    port=worker$worker
    { here <"$archive/docker/connect.properties" | sed "s|^listeners=.*|listeners=http://127.0.0.1:${!port}|; s|^rest.advertised.host.name=.*|rest.advertised.host.name=127.0.0.1|"
        echo "rest.advertised.port=${!port}"; } >"$run/connect-$worker.properties"
    start_worker "$worker"
    until_true 90 "Connect worker $worker" curl -fs "http://127.0.0.1:${!port}/health"
done
for connector in source sink; do here <"$archive/docker/connectors/ngsi-$connector.json" >"$run/ngsi-$connector.json"; done
words connectors entrypoint
curl_words=("${words[@]}")
words connectors command
"${curl_words[@]}" "${words[@]}" >"$logs/connectors.log"

say "Flink"
provide_flink
words jobmanager environment
mapfile -t settings < <(printf '%s\n' "${words[@]}" | grep -E '^(execution|classloader|metrics)\.')
task_slots=12 task_manager_memory=2g start_flink "${settings[@]}"

say "two control planes, devices, dashboard"
words control-plane command
start control-plane-2 env FURROW_OPTS="-Xms128m -Xmx512m" "$archive/bin/furrow" "${words[@]}" --control-port "$control2" --health-port "$health2"
start control-plane env FURROW_OPTS="-Xms128m -Xmx512m" "$archive/bin/furrow" "${words[@]}" --control-port "$control" --health-port "$health"
control_plane=$!
until_true 120 "The control plane" curl -fs "http://127.0.0.1:$health/ready"
until_true 120 "The second control plane" curl -fs "http://127.0.0.1:$health2/ready"
for service in simulators replay-analytics; do
    words "$service" command
    start "$service" env FURROW_OPTS="-Xms128m -Xmx384m" "$archive/bin/furrow" "${words[@]}"
done
words dashboard command
start dashboard env FURROW_OPTS="-Xms128m -Xmx384m" "$archive/bin/furrow" "${words[@]}" --port "$dashboard"
until_true 60 "The dashboard" curl -fs "http://127.0.0.1:$dashboard/"

say "jobs by flink run"
export FLINK_HOME CHECKPOINTS=$run/checkpoints INTERVAL=0
# submit JOB
submit() {
    words "job-$1" command
    words[0]=$archive/docker/flink/submit
    "${words[@]}" >"$logs/job-$1.log" 2>&1 || fail "Cannot submit $1: $logs/job-$1.log"
}
for job in ingest temperature collision presence coverage replay; do submit "$job"; done

# upgrade JOB: follows docs/install-three.md.
upgrade() {
    local id savepoint
    id=$("$FLINK_HOME/bin/flink" list | sed -n "s/.* : \([0-9a-f]*\) : $1 (RUNNING).*/\1/p")
    "$FLINK_HOME/bin/flink" stop --savepointPath "file://$CHECKPOINTS/$1" "$id" >"$logs/stop-$1.log" 2>&1 || fail "Cannot stop $1: $logs/stop-$1.log"
    savepoint=$(sed -n 's/.*Savepoint completed. Path: //p' "$logs/stop-$1.log")
    submit "$1"
    id=$(sed -n 's/.*submitted with JobID \([0-9a-f]*\).*/\1/p' "$logs/job-$1.log")
    until_true 60 "$1 from its savepoint ${savepoint:?}" restored "$id" "$savepoint"
    say "$1 restored from its savepoint"
}

# restored ID SAVEPOINT
restored() { curl -fs "$rest/jobs/$1/checkpoints" | grep -q "\"restored\":{[^}]*/${2##*/}\""; }

say "a mission"
export FURROW_API=http://127.0.0.1:$control FURROW_TOKEN_FILE=$run/secrets/api/tokens
furrow() { FURROW_OPTS="-Xms64m -Xmx256m" "$archive/bin/furrow" "$@"; }
demo=$home/simulators/devices/src/main/resources/io/furrow/simulators/demo
python3 -c 'import json,sys; print(json.dumps(json.load(open(sys.argv[1]))["templates"][0]["devices"]))' "$demo/missions.json" >"$run/devices.json"
furrow fields import "$demo/fields.geojson" --domain farm --valid-from 2020-01-01T00:00:00Z >"$logs/fields.log" 2>&1 || fail "Cannot import the fields: $logs/fields.log"
furrow domain create farm >"$logs/mission.log"
furrow mission start mine --domain farm --devices "$run/devices.json" >>"$logs/mission.log"
timeout 180 "$archive/bin/furrow" mission watch mine --until running >>"$logs/mission.log" || fail "The mission does not run: $logs/mission.log"

# found TYPE: whether results of that type have reached the context broker.
found() { curl -fs -H 'fiware-service: farm' "http://127.0.0.1:$orion/v2/entities?type=$1&limit=1" | grep -q '"id"'; }
until_true 180 "An average in the context broker" found Analytics:FieldTemperature
say "averages are in the context broker"
until_true 180 "An encounter in the context broker" found Analytics:Collision
say "encounters too"

# created DOMAIN: also true if the answer to an earlier attempt was lost.
created() { furrow domain create "$1" || furrow domain list | grep -q "$1"; }

# kill_worker NUMBER: kills a worker and restarts it.
kill_worker() {
    local killed=worker_$1
    kill -9 "${!killed}" && start_worker "$1"
}

# source_worker: prints the number of the worker that runs the task of the source.
source_worker() {
    curl -fs "http://127.0.0.1:$worker1/connectors/ngsi-source/status" |
        python3 -c 'import json,sys; print(1 if json.load(sys.stdin)["tasks"][0]["worker_id"].endswith(":" + sys.argv[1]) else 2)' "$worker1"
}

# measured DEVICES: whether the point with that many devices is complete. sending MESSAGES: whether a point of that many messages is being sent.
measured() { grep -q "\"devices\":$1," "$logs/load.jsonl"; }
sending() { tail -n 1 "$logs/load.log" | grep -q "[1-9][0-9]* of $1 sent"; }

say "a load, while a task manager, a control plane and both workers are killed, and two jobs are stopped with a savepoint"
start load env FURROW_OPTS="-Xms256m -Xmx512m" "$archive/bin/furrow" bench evaluate --against "127.0.0.1:$kafka" --orion "http://127.0.0.1:$orion" --iot-agent "http://127.0.0.1:$agent" \
    --mqtt "tcp://127.0.0.1:$mqtt" --mqtt-user iot-agent --mqtt-password-file "$run/secrets/mqtt/password" --sweeps DEVICES --seconds 30 --no-knee --results "$logs/load.jsonl" --report "$logs/load"
load=$!
until_true 180 "The messages of one device" measured 1
kill -9 "$task_manager" && start_task_manager
say "task manager killed"
until_true 180 "The messages of 10 devices" measured 10
kill -9 "$control_plane"
kill_worker "$((3 - $(source_worker)))"
say "a control plane and the worker without the source killed"
until_true 60 "A load of 25 devices" sending 3750
upgrade ingest
until_true 180 "A load of 50 devices" sending 7500
upgrade collision
export FURROW_API=http://127.0.0.1:$control2
until_true 90 "A domain by the second control plane" created spare
until_true 180 "A load of 100 or 125 devices" sending '\(15000\|18750\)'
kill_worker "$(source_worker)"
say "the worker with the source killed"
wait "$load" || fail "The load failed: $logs/load.log"
# The jobs are at-least-once: after the kill of the task manager they repeat the output since the last checkpoint.
python3 - "$logs/load.jsonl" <<'CHECK' || fail "Messages were lost or duplicated: $logs/load.log"
import json, sys
points = [json.loads(line) for line in open(sys.argv[1])]
for point in points:
    print("%4d devices  sent %d  delivered %d  duplicated %d" % (point["point"]["devices"], point["sent"], point["delivered"], point["duplicated"]))
sys.exit(0 if len(points) == 6 and all(point["delivered"] == point["sent"] and (point["duplicated"] == 0 or point["point"]["devices"] == 10) for point in points) else 1)
CHECK

say "its replay"
furrow mission stop mine >>"$logs/mission.log"
furrow replay start mine --speed max --topic data.mine.replay.0a1b2c3d >"$logs/replay.log"
timeout 120 "$archive/bin/furrow" replay watch mine.0a1b2c3d >>"$logs/replay.log" || fail "The replay did not end: $logs/replay.log"
tail -n 1 "$logs/replay.log"

say "metrics"
pages=$run/metrics.txt
for ((port = metrics; port < metrics + 10; port++)); do curl -fs "http://127.0.0.1:$port/metrics" || true; done >"$pages"
for port in "$notify" "$health2" "$dashboard"; do curl -fs "http://127.0.0.1:$port/metrics" >>"$pages" || fail "No server answers /metrics on port $port."; done
cp "$pages" "$logs/metrics.txt"
for metric in $(grep -ohE '\b(flink|furrow)_[A-Za-z_]+' "$archive/docker/grafana/dashboards/furrow.json" "$archive/docker/prometheus/alerts.yml" | sort -u); do
    grep -q "^$metric[{ ]" "$pages" || fail "The dashboard of Grafana or an alert uses $metric, which no server exports: $logs/metrics.txt"
done
! grep -q maxAllowedWatermark "$logs/jobmanager.out" || fail "The job manager logs each alignment of partitions: $logs/jobmanager.out"
echo "deployed: passed"
