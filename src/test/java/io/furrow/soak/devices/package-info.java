/** Two hundred devices with only an MQTT client and their credentials, on a farm whose parts are killed. */
package io.furrow.soak.devices;
