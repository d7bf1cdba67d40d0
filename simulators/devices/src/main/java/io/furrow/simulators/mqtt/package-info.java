/** Connects simulated devices with the MQTT broker: each with its own connection, or many through a gateway. */
package io.furrow.simulators.mqtt;
