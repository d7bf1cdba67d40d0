/** Makes wanted devices known to the IoT Agent and to the MQTT broker, and forgets those that are not wanted any more. */
package io.furrow.control.provisioning;
