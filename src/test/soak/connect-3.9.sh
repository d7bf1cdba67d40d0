#!/usr/bin/env bash
# Runs the NGSI connector on a Kafka 3.9 broker and a Connect 3.9 worker: one record through source and sink.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/kafka.sh
. "$soak/parts/kafka.sh"
# shellcheck source=parts/jars.sh
. "$soak/parts/jars.sh"

version=3.9.2
zip=

usage() {
    cat <<USAGE
Usage: ./furrow soak connect-3.9 [OPTION VALUE]…
Fetches Kafka and Connect once (some 60 MB), starts a broker and a distributed worker of that version with the packaged plugin, and
sends a notification to the source. The sink must write its entity to a receiver.

  --version V  Version of Kafka and Connect. Default: $version.
  --zip FILE   The plugin. Default: built from this checkout.
USAGE
}

read_options "version zip" "$@"
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "--version must be like 3.9.2, not '$version'."
command -v curl >/dev/null || fail "curl is missing, which calls the worker. Install curl."

prepare
libs=$home/target/soak/kafka-$version
classes=$run/conf:$libs/*
mkdir "$run/conf" "$run/plugins"

build() {
    say "building the plugin"
    (cd "$home" && ./mvnw -B -ntp package -DskipTests -Dspotless.check.skip -pl ngsi-connector -am) >"$logs/build.log" 2>&1 ||
        { grep -E '^\[ERROR\]' "$logs/build.log" | head -n 5 >&2; fail "The build failed."; }
    zip=$(ls -t "$home"/ngsi-connector/target/furrow-ngsi-connector-*.zip | head -n 1)
}

# The access rule needs Connect 4 or later.
has_access_rule() { ((${version%%.*} >= 4)); }

start_worker() {
    local port
    free_port && rest=127.0.0.1:$port
    cat >"$run/worker.properties" <<PROPERTIES
bootstrap.servers=$bootstrap
group.id=soak
plugin.path=$run/plugins
plugin.discovery=hybrid_fail
listeners=http://$rest
key.converter=org.apache.kafka.connect.storage.StringConverter
value.converter=org.apache.kafka.connect.converters.ByteArrayConverter
config.storage.topic=connect-configs
config.storage.replication.factor=1
offset.storage.topic=connect-offsets
offset.storage.replication.factor=1
offset.storage.partitions=1
status.storage.topic=connect-status
status.storage.replication.factor=1
status.storage.partitions=1
scheduled.rebalance.max.delay.ms=0
exactly.once.source.support=enabled
PROPERTIES
    if has_access_rule; then
        echo "rest.extension.classes=io.furrow.http.connect.AccessExtension" >>"$run/worker.properties"
    fi
    "$java" -Xmx512m -cp "$classes" org.apache.kafka.connect.cli.ConnectDistributed "$run/worker.properties" >"$logs/worker.log" 2>&1 &
    own $!
    until_true 120 "The Connect worker" curl -fsS "http://$rest/connectors"
}

runs() { curl -fsS "http://$rest/connectors/$1/status" | grep -q '"tasks":\[{"id":0,"state":"RUNNING"'; }

create() {
    curl -fsS -X PUT "http://$rest/connectors/$1/config" -H 'Content-Type: application/json' -d "$2" >>"$logs/rest.log" ||
        fail "The worker rejected the connector $1; logs: $logs"
    until_true 60 "The task of $1" runs "$1"
}

cat >"$run/conf/log4j.properties" <<'PROPERTIES'
log4j.rootLogger=WARN, out
log4j.logger.io.furrow=INFO
log4j.appender.out=org.apache.log4j.ConsoleAppender
log4j.appender.out.layout=org.apache.log4j.PatternLayout
log4j.appender.out.layout.ConversionPattern=%d %-5p %c %m%n
PROPERTIES

[[ -n $zip ]] || build
[[ -f $zip ]] || fail "There is no file $zip."
zip=$(cd "$(dirname "$zip")" && pwd)/$(basename "$zip")
fetch_jars "$libs" "org.apache.kafka:"{connect-runtime,kafka_2.13}":$version" org.slf4j:slf4j-reload4j:1.7.36
(cd "$run/plugins" && "${java%java}jar" xf "$zip")
say "starting Kafka $version"
start_kafka
say "starting Connect $version with $(basename "$zip")"
start_worker
curl -fsS "http://$rest/" | grep -q "\"version\":\"$version\"" || fail "The worker is not of version $version."

if has_access_rule; then
    [[ $(curl -s -o "$logs/rejected.json" -w '%{http_code}' -H 'Host: evil.example' "http://$rest/connectors") == 403 ]] ||
        fail "The worker accepted a foreign Host header; logs: $logs"
    say "the worker rejects a foreign Host header"
fi

free_port && listen=$port
free_port && receive=$port
"$java" "$soak/parts/Receiver.java" "$receive" >"$logs/received.log" 2>&1 &
own $!
until_true 30 "The receiver" open_port "$receive"
create ngsi-source '{"connector.class": "io.furrow.connect.source.NgsiSourceConnector", "tasks.max": "1",
    "listen.port": "'"$listen"'", "journal.dir": "'"$run"'/journal", "topic": "data.raw", "exactly.once.support": "required"}'
create ngsi-sink '{"connector.class": "io.furrow.connect.sink.NgsiSinkConnector", "tasks.max": "1", "topics": "data.raw",
    "context.broker.url": "http://127.0.0.1:'"$receive"'", "echo.sources": "", "consumer.override.metadata.max.age.ms": "500"}'
say "both connectors run"
curl -fsS -X POST "http://127.0.0.1:$listen/v2/notify" -H 'Content-Type: application/json' -d '{
    "id": "urn:ngsi-ld:Thermometer:1", "type": "Thermometer", "Temperature": {"type": "Float", "value": 21.5}}' ||
    fail "The source rejected the notification; logs: $logs"
until_true 60 "The entity at the receiver" grep -q '^POST /v2/op/update .*urn:ngsi-ld:Thermometer:1.*21.5' "$logs/received.log"
say "the entity has passed source and sink"
runs ngsi-source && runs ngsi-sink || fail "A task has failed; logs: $logs"
echo "connect-3.9: passed on Kafka and Connect $version"
