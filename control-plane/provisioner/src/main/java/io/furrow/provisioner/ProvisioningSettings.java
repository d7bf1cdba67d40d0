package io.furrow.provisioner;

import java.util.List;
import java.util.Properties;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;
import io.furrow.provisioner.account.MqttAccounts;

/**
 * What devices are provisioned with.
 *
 * @param client settings of Kafka clients, {@code bootstrap.servers} among them
 * @param scope of the missions' devices
 * @param secret of the farm, of which API keys and passwords are made
 * @param agent that is notified of the devices
 * @param accounts of the MQTT brokers; none where the broker lets everybody in that the IoT Agent shall hear
 * @param gateways whether each mission has an account that may speak for all its devices, as a host of many devices needs it
 * @param connections who knows how devices are connected
 * @param forgets whether accounts and devices are removed that a Kafka does not want which is empty, or not the one they were made for
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
    /** Which forgets nothing, without anybody who knows how devices are connected. */
    public ProvisioningSettings(
            Properties client,
            FiwareScope scope,
            SecretSource secret,
            AgentSettings agent,
            List<MqttAccounts> accounts,
            boolean gateways) {
        this(client, scope, secret, agent, accounts, gateways, ConnectionSources.NONE, false);
    }

    /** With a secret that does not change, and without accounts of gateways. */
    public ProvisioningSettings(
            Properties client, FiwareScope scope, FarmSecret secret, AgentSettings agent, List<MqttAccounts> accounts) {
        this(client, scope, SecretSource.of(secret), agent, accounts, false);
    }
}
