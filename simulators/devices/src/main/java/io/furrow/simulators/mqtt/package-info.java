/** How simulated devices reach the MQTT broker: with a connection each, or many through a gateway. */
package io.furrow.simulators.mqtt;
