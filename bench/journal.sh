#!/usr/bin/env bash
# Compares journals on this machine's disk: bench/journal.sh [FOLDER [SECONDS]]; see docs/adr/0007-journal.md.
set -euo pipefail

home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:-$home/bench/target/journals}
(cd "$home" && ./mvnw -B -q -pl bench -am test-compile dependency:build-classpath \
    -Dmdep.includeScope=test -Dmdep.outputFile="$home/bench/target/journal.classpath")
exec "${JAVA_HOME:+$JAVA_HOME/bin/}java" -cp "$home/bench/target/test-classes:$(cat "$home/bench/target/journal.classpath")" \
    io.furrow.bench.journal.JournalComparison "$folder" "${2:-4}"
