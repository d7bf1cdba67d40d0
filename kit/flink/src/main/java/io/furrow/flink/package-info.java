/**
 * Common parts of the Flink jobs. Two jobs never depend on each other, they are connected by topics.
 *
 * <p><b>In</b>: options of the command line, records of Kafka topics.
 *
 * <p><b>Out</b>: sources with watermarks, sinks, dead letters, topics that exist.
 *
 * <p><b>Must not know</b>: what any job computes.
 */
package io.furrow.flink;
