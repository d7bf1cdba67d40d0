/**
 * A stand-in for FIWARE's IoT Agent JSON and its context broker Orion, for use without real ones: the part of their behavior
 * that Furrow uses, over real MQTT and HTTP, tested against recorded notifications of Orion 4.7 and recorded exchanges with
 * Orion 4.7 and IoT Agent JSON 3.14.
 *
 * <p><b>In</b>: NGSI v2 requests, provisioning requests and measures over MQTT.
 *
 * <p><b>Out</b>: notifications, commands over MQTT, answers; 400 for unsupported features of Orion.
 *
 * <p><b>Must not know</b>: Furrow's topics and jobs: it is what they find at the edge.
 */
package io.furrow.fiware;
