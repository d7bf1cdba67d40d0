#!/usr/bin/env bash
# Runs the JMH benchmarks whose names match: bench/jmh.sh EntityReading [JMH OPTIONS]; no pattern runs all, -h explains.
set -euo pipefail

home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
target=$home/bench/target
(cd "$home" && ./mvnw -B -q -pl bench -am test-compile dependency:build-classpath \
    -Dmdep.includeScope=test -Dmdep.outputFile="$target/jmh.classpath")
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
path=$target/test-classes:$target/classes:$(cat "$target/jmh.classpath")

# JMH writes a class around each benchmark.
rm -rf "$target/jmh"
mkdir -p "$target/jmh/sources" "$target/jmh/classes"
"$java" -cp "$path" org.openjdk.jmh.generators.bytecode.JmhBytecodeGenerator \
    "$target/test-classes" "$target/jmh/sources" "$target/jmh/classes" >"$target/jmh/generator.log"
find "$target/jmh/sources" -name '*.java' >"$target/jmh/sources.list"
"${java}c" -nowarn -proc:none -d "$target/jmh/classes" -cp "$path" @"$target/jmh/sources.list"

exec "$java" -cp "$target/jmh/classes:$path" org.openjdk.jmh.Main -prof gc "$@"
