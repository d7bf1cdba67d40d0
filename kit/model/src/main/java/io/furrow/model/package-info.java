/**
 * What all modules agree on: entities, events, topics, commands, results.
 *
 * <p><b>In</b>: bytes of NGSI-v2, NGSI-LD and of the records on Furrow's topics.
 *
 * <p><b>Out</b>: values, and the same bytes again.
 *
 * <p><b>Must not know</b>: Kafka, Flink, HTTP or any other module: plain Java and Jackson.
 */
package io.furrow.model;
