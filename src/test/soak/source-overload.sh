#!/usr/bin/env bash
# Overloads an NGSI source whose journal is full; its memory must stay flat.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/connector.sh
. "$soak/parts/connector.sh"

seconds=120
senders=400
bytes=1000000
heap=96

usage() {
    cat <<USAGE
Usage: ./furrow soak source-overload [OPTION VALUE]…
Starts a source with a journal of 64 MiB that is not drained, and senders that send as fast as they can, each on its own connection.
Prints the resident memory every ten seconds. At the end it must be less than 64 MiB above that of the first quarter.

  --seconds N  Duration, at least 40. Default: $seconds.
  --senders N  Concurrent connections. Default: $senders.
  --bytes N    Size of a notification. Default: $bytes.
  --heap N     MiB of heap of the source. Default: $heap.
USAGE
}

read_options "seconds senders bytes heap" "$@"
check_numbers 40 seconds
check_numbers 1 senders bytes heap

prepare
build_connector

mkfifo "$run/in"
"$java" -Xmx"${heap}m" -XX:MaxDirectMemorySize=64m -XX:+ExitOnOutOfMemoryError -cp "$connector_classes" \
    io.furrow.connect.source.BlockedSource "$run/journal" <"$run/in" >"$logs/source.log" 2>&1 &
source=$!
own "$source"
exec 9>"$run/in" # the source runs until its input is closed
until_true 30 "The source" grep -q '^port ' "$logs/source.log"
port=$(sed -n 's/^port //p' "$logs/source.log")
"$java" -Xmx256m -cp "$connector_classes" io.furrow.connect.source.PressingSenders "$port" "$senders" "$bytes" "$seconds" \
    >"$logs/senders.log" 2>&1 &
pressing=$!
own "$pressing"

resident() { sed -n 's/^VmRSS:[^0-9]*\([0-9]*\).*/\1/p' "/proc/$source/status" 2>/dev/null || true; }
first=0
last=0
for ((passed = 10; passed <= seconds; passed += 10)); do
    sleep 10
    last=$(resident)
    [[ -n $last ]] || { tail -n 5 "$logs/source.log" >&2; fail "The source has ended."; }
    say "$((last / 1024)) MiB resident"
    ((passed > seconds / 4)) || first=$last
done
wait "$pressing" || true
say "senders: $(tail -n 1 "$logs/senders.log")"
curl -sf -m 10 "http://127.0.0.1:$port/health" >"$logs/health.json" || fail "The source does not respond."
say "$(cat "$logs/health.json")"
((last < first + 65536)) || fail "The memory of the source grew from $((first / 1024)) to $((last / 1024)) MiB."
echo "source-overload: passed"
