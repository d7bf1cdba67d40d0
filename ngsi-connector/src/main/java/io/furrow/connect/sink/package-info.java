/**
 * From Kafka into the context broker: {@link io.furrow.connect.sink.NgsiSinkConnector}. Only the connector, its task and
 * its configuration know Connect.
 */
package io.furrow.connect.sink;
