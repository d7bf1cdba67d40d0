#!/usr/bin/env bash
# Stops Kafka for a minute while the NGSI source is under load; nothing may be lost, and it must catch up sooner.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

rate=2000
seconds=60

usage() {
    cat <<USAGE
Usage: ./furrow soak source-outage [OPTION VALUE]…
Runs the NGSI source in a distributed Connect worker with the worker's default timeouts, beside a Kafka broker, both started
for this. While notifications come in, the broker is stopped and started again. Every notification must be answered 200 and be
on data.raw, and the source must have caught up in less time than the outage took. The worker's heap is 384 MiB; on Linux
its resident memory is shown and must stay below 700 MiB.

  --rate N      Notifications of 1 kB per second. Default: $rate.
  --seconds N   How long the broker is stopped. Default: $seconds.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --rate) rate=${2-} ;;
        --seconds) seconds=${2-} ;;
        *) fail "source-outage knows no option $1. See: ./furrow soak source-outage --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak source-outage --help"
    shift 2
done
[[ $rate =~ ^[1-9][0-9]*$ ]] || fail "--rate must be a whole number from 1, not '$rate'."
[[ $seconds =~ ^[1-9][0-9]*$ ]] || fail "--seconds must be a whole number from 1, not '$seconds'."

prepare_source source-outage
run_source SourceOutage "$run/outage" "$rate" "$seconds" || fail "Something was lost, refused, or it took too long to catch up."
echo "source-outage: passed"
