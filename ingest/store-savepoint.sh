#!/usr/bin/env bash
# Stores a savepoint of the job as it is now, for every later build to restore: ingest/store-savepoint.sh RELEASE.
set -euo pipefail

[[ ${1:-} =~ ^[0-9]+(\.[0-9]+)+$ && $# == 1 ]] || { echo "Usage: ingest/store-savepoint.sh RELEASE, for instance 0.2.0" >&2; exit 1; }
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
(cd "$home" && ./mvnw -B -q -pl ingest -am test-compile dependency:build-classpath \
    -Dmdep.includeScope=test -Dmdep.outputFile="$home/ingest/target/test.classpath")
opens=()
for package in lang util; do opens+=("--add-opens=java.base/java.$package=ALL-UNNAMED"); done
cd "$home/ingest"
exec "${JAVA_HOME:+$JAVA_HOME/bin/}java" "${opens[@]}" -cp "target/test-classes:target/classes:$(cat target/test.classpath)" \
    io.furrow.ingest.StoredSavepoint "$1"
