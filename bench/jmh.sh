#!/usr/bin/env bash
# Runs the JMH benchmarks whose names match: bench/jmh.sh EntityReading [JMH OPTIONS]; no pattern runs all, -h explains.
set -euo pipefail

home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
(cd "$home" && ./mvnw -B -q -pl bench -am test-compile dependency:build-classpath \
    -Dmdep.includeScope=test -Dmdep.outputFile="$home/bench/target/jmh.classpath")
exec "${JAVA_HOME:+$JAVA_HOME/bin/}java" -cp "$home/bench/target/test-classes:$(cat "$home/bench/target/jmh.classpath")" \
    org.openjdk.jmh.Main -prof gc "$@"
