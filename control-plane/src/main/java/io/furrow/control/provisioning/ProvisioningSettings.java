package io.furrow.control.provisioning;

import java.net.URI;
import java.util.List;
import java.util.Properties;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;

/**
 * What devices are provisioned with.
 *
 * @param client settings of Kafka clients, {@code bootstrap.servers} among them
 * @param scope of the missions' devices
 * @param secret of the farm, of which API keys and passwords are made
 * @param iotAgent base of the IoT Agent's provisioning interface, as in {@code http://127.0.0.1:4041}
 * @param accounts of the MQTT brokers; none where the broker lets everybody in that the IoT Agent shall hear
 */
public record ProvisioningSettings(
        Properties client, FiwareScope scope, FarmSecret secret, URI iotAgent, List<MqttAccounts> accounts) {}
