/**
 * Writes entities from Kafka to the context broker: {@link io.furrow.connect.sink.NgsiSinkConnector}. Only the
 * connector, its task and its configuration depend on Connect.
 */
package io.furrow.connect.sink;
