#!/usr/bin/env bash
# Brings bad records of every kind among good ones through normalize and ingest, and counts what becomes of them.
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
Writes good events, half of them native notifications, half records of data.raw, and among them bad records of the kinds of
src/test/resources/io/furrow/soak/bad-records.txt, to a Kafka of its own, and runs normalize and ingest on a Flink of its
own, all in one JVM. Then every good event must have come out once, and every bad record be a dead letter with its reason;
brought back to their topics, all must become the same dead letters again.

  --good N  Good events. Default: $good.
  --bad N   Bad records. Default: $bad.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --good) good=${2-} ;;
        --bad) bad=${2-} ;;
        *) fail "bad-records knows no option $1. See: ./furrow soak bad-records --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak bad-records --help"
    shift 2
done
[[ $good =~ ^[1-9][0-9]{0,8}$ ]] || fail "--good must be a whole number from 1, not '$good'."
[[ $bad =~ ^[0-9]{1,9}$ ]] || fail "--bad must be a whole number, not '$bad'."

logs=$home/target/soak/bad-records
rm -rf "$logs"
mkdir -p "$logs"
build_soaks system-tests

opens=(--add-exports=java.rmi/sun.rmi.registry=ALL-UNNAMED)
for package in lang net io nio lang.reflect text time util util.concurrent util.concurrent.atomic util.concurrent.locks; do
    opens+=("--add-opens=java.base/java.$package=ALL-UNNAMED")
done
opens+=(--add-opens=java.base/sun.nio.ch=ALL-UNNAMED)

say "$good good events and $bad bad records"
"$java" -Xmx1536m -XX:+UseParallelGC "${opens[@]}" -Dfurrow.log="$logs/furrow.log" \
    -cp "$home/src/target/test-classes:$home/suite/launcher/target/furrow/lib/*" io.furrow.soak.BadAmongGood "$good" "$bad" ||
    fail "What came out differs from what went in; log: $logs/furrow.log"
say "all is accounted for"
echo "bad-records: passed"
