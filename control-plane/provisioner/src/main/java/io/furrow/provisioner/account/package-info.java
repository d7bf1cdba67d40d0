/** Manages the accounts of devices at MQTT brokers. */
package io.furrow.provisioner.account;
