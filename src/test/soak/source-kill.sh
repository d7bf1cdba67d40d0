#!/usr/bin/env bash
# Kills the worker of the NGSI source repeatedly under load; every answered notification must be in Kafka.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

rounds=20
rate=1000
exactly_once=both
seed=$RANDOM

usage() {
    cat <<USAGE
Usage: ./furrow soak source-kill [OPTION VALUE]…
Starts a Kafka broker and a distributed Connect worker with the NGSI source. In each round, notifications are sent while the worker is
killed (kill -9) at a random moment and restarted. Every notification that was answered 200 must then be on data.raw: once with
exactly-once delivery, otherwise at least once with the same ce_id.

  --rounds N            Kills. Default: $rounds.
  --rate N              Notifications of 1 kB per second. Default: $rate.
  --exactly-once MODE   on, off or both. Default: $exactly_once.
  --seed N              Seed of the random moments. Default: random; it is printed.
USAGE
}

read_options "rounds rate exactly-once seed" "$@"
check_numbers 1 rounds rate
check_numbers 0 seed
check_choice exactly-once on off both
case $exactly_once in on) modes=true ;; off) modes=false ;; *) modes="true false" ;; esac

prepare_source
for mode in $modes; do
    run_program source.SourceKill "$run/$mode" "$rounds" "$rate" "$mode" "$seed" || fail "An answered notification is missing or duplicated."
done
echo "source-kill: passed"
