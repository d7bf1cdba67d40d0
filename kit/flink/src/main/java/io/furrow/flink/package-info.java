/**
 * What the Flink jobs share. Two jobs never import each other, they meet in a topic.
 *
 * <p><b>In</b>: options of the command line, records of Kafka topics.
 *
 * <p><b>Out</b>: sources with watermarks, sinks, dead letters, topics that exist.
 *
 * <p><b>Must not know</b>: what any job computes.
 */
package io.furrow.flink;
