/**
 * Common parts of the long-running services besides the model: readers of topics without a consumer group, workers that
 * restart after a failure, the secret of the farm, its fields.
 *
 * <p><b>In</b>: any topic, from its beginning or a time.
 *
 * <p><b>Out</b>: records, in order per partition, and whether all of them were read.
 *
 * <p><b>Must not know</b>: what the records mean, Flink, Kafka Streams.
 */
package io.furrow.kafka;
