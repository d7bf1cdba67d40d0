#!/usr/bin/env bash
# Runs docker/compose.yaml in containers of podman: a mission and its replay, a reboot, killed containers.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/flink.sh
. "$soak/parts/flink.sh"
# shellcheck source=parts/jars.sh
. "$soak/parts/jars.sh"
# shellcheck source=parts/images.sh
. "$soak/parts/images.sh"

usage() {
    cat <<USAGE
Usage: ./furrow soak containers
Unpacks suite/distribution/target/furrow-*.tar.gz (built by ./mvnw package -Prelease -DskipTests), makes the images that its
docker/compose.yaml names, and runs them with podman, which needs root. Mosquitto and Java are Debian's, Kafka and HDFS are from Maven
Central, Flink is from PyPI; one container runs stand-ins of Orion, the IoT Agent and MongoDB (parts/images/compose.override.yaml).
The ports of the file must be free on 127.0.0.1.
USAGE
}

read_options "" "$@"
for tool in podman:podman runc:runc mmdebstrap:mmdebstrap curl:curl python3:python3-pip; do
    command -v "${tool%:*}" >/dev/null || fail "${tool%:*} is missing. Install ${tool#*:}."
done
prepare

tar xzf "$home"/suite/distribution/target/furrow-*.tar.gz -C "$run"
archive=$(echo "$run"/furrow-*)
docker=$archive/docker
"$archive/bin/furrow" init "$docker/secrets" >/dev/null
echo mongodb://mongo:27017 >"$docker/secrets/mongo/uri"
# A stand-in of the context broker sends notifications again, so that a missing one was acknowledged.
sed -i 's|"public.url": "http://|"allowed.hosts": "connect",\n  &127.0.0.1:8090/|' "$docker/connectors/ngsi-source.json"
make_images
provide_compose

project=furrow-soak
socket=unix://$run/podman.sock
podman system service --time=0 "$socket" >"$logs/podman.log" 2>&1 &
own $!
until_true 30 "podman's socket" test -S "$run/podman.sock"

compose() {
    DOCKER_HOST=$socket "$compose" --ansi never -p "$project" --project-directory "$docker" -f "$docker/compose.yaml" \
        -f "$soak/parts/images/compose.override.yaml" --profile core --profile simulators "$@"
}

# containers [FILTER…]: prints the names of the containers.
containers() { podman ps --all --format '{{.Names}}' --filter "label=com.docker.compose.project=$project" "${@/#/--filter=}"; }

# Docker would do so; podman leaves it to systemd.
check_health() {
    local name
    while sleep 2; do
        for name in $(containers status=running); do podman healthcheck run "$name" || true; done
    done
}
check_health >/dev/null 2>&1 &
own $!

save_logs() {
    local name
    for name in $(containers); do podman logs "$name" >"$logs/${name#"$project"-}.log" 2>&1 || true; done
    # A container that is being restarted is removed the next time.
    until containers | xargs -r podman rm --force --time 1; do sleep 1; done >>"$logs/podman.log" 2>&1
    podman volume ls --quiet --filter "label=com.docker.compose.project=$project" | xargs -r podman volume rm >/dev/null
    podman network rm "${project}_default" >/dev/null 2>&1 || true
}

say "starting the containers"
compose up --detach --no-build >"$logs/up.log" 2>&1 || fail "The containers do not start: $logs/up.log"

# ready: whether all jobs run, all containers are healthy and the control plane is ready.
ready() {
    local jobs
    [[ -z $(containers health=starting)$(containers health=unhealthy) ]] || return
    jobs=$(curl -fs http://127.0.0.1:8081/jobs/overview | grep -o '"state":"RUNNING"' | wc -l)
    ((jobs == 6)) && curl -fs http://127.0.0.1:8086/ready && curl -fs http://127.0.0.1:8080/
}
until_true 180 "The farm" ready

say "a mission"
export FURROW_API=http://127.0.0.1:8085 FURROW_TOKEN_FILE=$docker/secrets/api/tokens
furrow() { FURROW_OPTS="-Xms64m -Xmx256m" "$archive/bin/furrow" "$@"; }
furrow fields import "$archive/examples/fields.geojson" --domain farm >"$logs/mission.log"
furrow domain create farm >>"$logs/mission.log"
furrow mission start mine --domain farm --template thesis-demo >>"$logs/mission.log"
timeout 180 "$archive/bin/furrow" mission watch mine --until running >>"$logs/mission.log" || fail "The mission does not run: $logs/mission.log"

# found TYPE: whether results of that type have reached the context broker.
found() { curl -fs -H 'fiware-service: farm' "http://127.0.0.1:1026/v2/entities?type=$1&limit=1" | grep -q '"id"'; }
until_true 180 "An average in the context broker" found Analytics:FieldTemperature
until_true 180 "An encounter in the context broker" found Analytics:Collision
say "averages and encounters are in the context broker"

process() { podman inspect --format '{{.State.Pid}}' "$project-$1-1"; }
# restarted NAME PID: whether another process runs there.
restarted() { [[ $(process "$1") != 0 && $(process "$1") != "$2" ]]; }

# kill_service NAME: kills it as a crash does; the engine starts it again.
kill_service() {
    local pid
    pid=$(process "$1")
    kill -9 "$pid"
    say "$1 killed"
    until_true 60 "Another process of $1" restarted "$1" "$pid"
    until_true 120 "The farm after the death of $1" ready
    say "everything runs again"
}

# measured DEVICES: whether the point with that many devices is complete.
measured() { grep -q "\"devices\":$1," "$logs/load.jsonl"; }

say "a load, while containers are killed"
FURROW_OPTS="-Xms256m -Xmx512m" "$archive/bin/furrow" bench evaluate --against 127.0.0.1:9094 --orion http://127.0.0.1:1026 --iot-agent http://127.0.0.1:4041 \
    --mqtt tcp://127.0.0.1:1883 --mqtt-user iot-agent --mqtt-password-file "$docker/secrets/mqtt/password" --sweeps DEVICES --seconds 30 --no-knee \
    --results "$logs/load.jsonl" --report "$logs/load" >"$logs/load.log" 2>&1 &
load=$!
own "$load"
until_true 180 "The messages of one device" measured 1
for service in taskmanager jobmanager connect control-plane kafka; do kill_service "$service"; done
wait "$load" || fail "The load failed: $logs/load.log"
# A job that is restored repeats its output since its newest checkpoint.
python3 - "$logs/load.jsonl" <<'CHECK' || fail "Messages were lost: $logs/load.log"
import json, sys
points = [json.loads(line) for line in open(sys.argv[1])]
for point in points:
    print("%4d devices  sent %d  delivered %d  duplicated %d" % (point["point"]["devices"], point["sent"], point["delivered"], point["duplicated"]))
sys.exit(0 if len(points) == 6 and all(point["delivered"] == point["sent"] for point in points) else 1)
CHECK

say "a reboot"
containers status=running | xargs podman kill >/dev/null
containers | xargs podman inspect --format '{{.HostConfig.RestartPolicy.Name}} {{.Name}}' | sed -n 's/^unless-stopped //p' | xargs podman start >"$logs/reboot.log"
until_true 120 "The farm after the reboot" ready
say "everything runs again"
# reports TIME: whether the context broker has a measure of a thermometer from after that time.
reports() {
    curl -fs -H 'fiware-service: farm' 'http://127.0.0.1:1026/v2/entities?type=Thermometer&options=keyValues&attrs=TimeInstant' |
        python3 -c 'import json,sys; sys.exit(not any(each.get("TimeInstant", "") > sys.argv[1] for each in json.load(sys.stdin)))' "$1"
}
# status TOKEN: prints the status code with which the REST API answers.
status() { curl -s -o /dev/null -w '%{http_code}' -H "Authorization: Bearer $1" "$FURROW_API/api/v1/missions"; }
random() { od -An -N24 -tx1 /dev/urandom | tr -d ' \n'; }

until_true 60 "Measures after the reboot" reports "$(date -u +%FT%TZ)"
say "new secrets of MQTT and of the REST API"
token=$(cut -d' ' -f2 "$docker/secrets/api/tokens")
echo "admin $(random) admin" >"$docker/secrets/api/tokens"
random >"$docker/secrets/mqtt/password"
compose restart mosquitto orion control-plane >"$logs/restart.log" 2>&1
until_true 120 "The farm with new secrets" ready
[[ $(status "$token") == 401 ]] || fail "The REST API accepts the old token."
furrow mission list >/dev/null
until_true 60 "Measures with the new password" reports "$(date -u +%FT%TZ)"
for secret in "$docker"/secrets/*/*; do
    ! containers | xargs podman inspect | grep -qF "$(tail -n 1 "$secret")" || fail "podman inspect shows ${secret#"$docker"/}."
done

say "a replay"
furrow mission stop mine >>"$logs/mission.log"
furrow replay start mine --speed max --topic data.mine.replay.0a1b2c3d >"$logs/replay.log"
timeout 120 "$archive/bin/furrow" replay watch mine.0a1b2c3d >>"$logs/replay.log" || fail "The replay did not end: $logs/replay.log"
tail -n 1 "$logs/replay.log"
say "a stop"
compose stop >"$logs/stop.log" 2>&1
for name in $(containers); do
    (($(podman inspect --format '{{.State.ExitCode}}' "$name") != 137)) || fail "$name did not stop within its grace period."
done
echo "containers: passed"
