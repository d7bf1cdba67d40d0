#!/usr/bin/env bash
# Sends bad records of every kind among good events through normalize and ingest, and counts events and dead letters.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/build.sh
. "$soak/parts/build.sh"

good=1000000
bad=10000

usage() {
    cat <<USAGE
Usage: ./furrow soak bad-records [OPTION VALUE]…
Runs Kafka, Flink, normalize and ingest in one JVM. Writes good events, half of them native notifications, half records of data.raw,
and among them bad records of the kinds in src/test/resources/io/furrow/soak/bad-records.txt. Every good event must be emitted once,
and every bad record must be a dead letter with its reason. After a redrive, all must become the same dead letters again.

  --good N  Good events. Default: $good.
  --bad N   Bad records. Default: $bad.
USAGE
}

read_options "good bad" "$@"
check_numbers 1 good
check_numbers 0 bad

prepare
build_soaks

opens=(--add-exports=java.rmi/sun.rmi.registry=ALL-UNNAMED)
for package in lang net io nio lang.reflect text time util util.concurrent util.concurrent.atomic util.concurrent.locks; do
    opens+=("--add-opens=java.base/java.$package=ALL-UNNAMED")
done
opens+=(--add-opens=java.base/sun.nio.ch=ALL-UNNAMED)

say "$good good events and $bad bad records"
"$java" -Xmx1536m -XX:+UseParallelGC "${opens[@]}" -Dfurrow.log="$logs/furrow.log" \
    -cp "$home/src/target/test-classes:$home/suite/launcher/target/furrow/lib/*" io.furrow.soak.BadAmongGood "$good" "$bad" ||
    fail "Events or dead letters differ from the records written; log: $logs/furrow.log"
say "every record is accounted for"
echo "bad-records: passed"
