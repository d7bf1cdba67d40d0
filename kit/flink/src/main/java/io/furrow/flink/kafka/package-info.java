/** Sources and sinks of Kafka, and the topics that a job reads from and writes to. */
package io.furrow.flink.kafka;
