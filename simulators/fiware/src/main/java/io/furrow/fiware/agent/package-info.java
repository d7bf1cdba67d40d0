/** IoT Agent JSON: service groups, devices, measures and commands over MQTT. */
package io.furrow.fiware.agent;
