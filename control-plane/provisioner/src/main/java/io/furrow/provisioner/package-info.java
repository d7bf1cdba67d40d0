/**
 * Registers desired devices with the IoT Agent and the MQTT broker, and removes those that are no longer desired.
 *
 * <p><b>In</b>: {@code service.devices}, {@code service.missions.devices}, the farm's secret.
 *
 * <p><b>Out</b>: groups and devices of the IoT Agent, accounts of the MQTT broker, {@code service.devices.status}.
 *
 * <p><b>Must not know</b>: the managers and their REST API; they communicate through topics.
 */
package io.furrow.provisioner;
