/**
 * Simulated farms, a load fleet, the host of the devices of missions, and a stand-in for IoT Agent and context broker.
 *
 * <p><b>In</b>: scenario files, the desired devices on {@code service.devices}, commands over MQTT and NGSI.
 *
 * <p><b>Out</b>: measures over MQTT, entities of robots, {@code service.devices.status}.
 *
 * <p><b>Must not know</b>: ingest, analytics, the managers: it meets them in topics and at the context broker.
 */
package io.furrow.simulators;
