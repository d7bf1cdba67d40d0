/**
 * From the context broker into Kafka: {@link io.furrow.connect.source.NgsiSourceConnector}. Only the connector, its task
 * and its configuration know Connect.
 */
package io.furrow.connect.source;
