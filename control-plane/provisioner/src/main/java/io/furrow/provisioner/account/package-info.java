/** Accounts of devices at an MQTT broker. */
package io.furrow.provisioner.account;
