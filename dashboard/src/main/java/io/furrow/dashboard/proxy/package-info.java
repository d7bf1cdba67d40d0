/** Topics of Kafka over WebSocket and as server-sent events. */
package io.furrow.dashboard.proxy;
