/**
 * The engines in one JVM, on loopback: for the one-command start and for tests, never on a cluster.
 *
 * <p><b>In</b>: ports and folders.
 *
 * <p><b>Out</b>: addresses of a running Kafka, Connect, Flink, MQTT broker and MongoDB stand-in.
 *
 * <p><b>Must not know</b>: what runs on the engines.
 */
package io.furrow.embedded;
