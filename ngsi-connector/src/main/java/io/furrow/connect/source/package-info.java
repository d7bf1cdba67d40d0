/**
 * Writes notifications of the context broker to Kafka: {@link io.furrow.connect.source.NgsiSourceConnector}. Only the
 * connector, its task and its configuration depend on Connect.
 */
package io.furrow.connect.source;
