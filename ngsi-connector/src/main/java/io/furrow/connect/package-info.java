/** Kafka Connect plugin between a context broker and Kafka: a source in one direction, a sink in the other. */
package io.furrow.connect;
