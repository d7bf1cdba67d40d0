package io.furrow.provisioner;

import java.util.List;
import java.util.Properties;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;
import io.furrow.provisioner.account.MqttAccounts;

/**
 * Settings of the provisioner.
 *
 * @param client settings of Kafka clients, including {@code bootstrap.servers}
 * @param scope of the missions' devices
 * @param secret of the farm, from which API keys and passwords are derived
 * @param agent at which devices are registered
 * @param accounts of the MQTT brokers; empty if the brokers do not authenticate devices
 * @param gateways whether each mission has an account for all of its devices, as a host of many devices needs
 * @param connections sources of reports about the connections of devices
 * @param forgets whether undesired accounts and devices are removed even if Kafka is empty or not the one for which
 *     they were created
 */
public record ProvisioningSettings(
        Properties client,
        FiwareScope scope,
        SecretSource secret,
        AgentSettings agent,
        List<MqttAccounts> accounts,
        boolean gateways,
        ConnectionSources connections,
        boolean forgets) {
    /** Creates settings that retain devices of another Kafka, without sources of connection reports. */
    public ProvisioningSettings(
            Properties client,
            FiwareScope scope,
            SecretSource secret,
            AgentSettings agent,
            List<MqttAccounts> accounts,
            boolean gateways) {
        this(client, scope, secret, agent, accounts, gateways, ConnectionSources.NONE, false);
    }

    /** Creates settings with a fixed secret, without accounts of gateways. */
    public ProvisioningSettings(
            Properties client, FiwareScope scope, FarmSecret secret, AgentSettings agent, List<MqttAccounts> accounts) {
        this(client, scope, SecretSource.of(secret), agent, accounts, false);
    }
}
