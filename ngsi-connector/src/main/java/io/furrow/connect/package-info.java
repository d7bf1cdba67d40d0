/**
 * Kafka Connect plugin between a context broker and Kafka: a source in one direction, a sink in the other.
 *
 * <p><b>In</b>: notifications over HTTP (source), records of result topics (sink).
 *
 * <p><b>Out</b>: {@code data.raw} and dead letters (source), updates of entities (sink).
 *
 * <p><b>Must not know</b>: Flink, domains and missions.
 */
package io.furrow.connect;
