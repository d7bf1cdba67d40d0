package io.furrow.provisioner.account;

import java.io.IOException;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.WantedDevice;
import io.furrow.provisioner.ProvisioningSettings;

/**
 * The accounts of devices at the MQTT brokers. What nobody shall get in with any more, as the password of a stolen device, is
 * removed whether the IoT Agent answers or not; an account is granted once the agent knows the device.
 */
public final class DeviceAccounts {
    private final List<MqttAccounts> brokers;
    private final SecretSource secret;
    private final boolean gateways;
    /** As all brokers have them; null if that is not known. */
    private List<MqttAccount> granted;

    private Set<String> allowed;
    private Map<String, String> refused = Map.of();

    public DeviceAccounts(ProvisioningSettings settings) {
        this.brokers = settings.accounts();
        this.secret = settings.secret();
        this.gateways = settings.gateways();
    }

    /** Takes nothing for granted: another process may have been at work. */
    public void startAnew() {
        granted = null;
        allowed = null;
    }

    /** Tries those again that a broker has refused. */
    public void retryRefused() {
        if (!refused.isEmpty()) {
            granted = null;
        }
    }

    /** Removes the accounts that none of the desired devices has any more. */
    public void revoke(Collection<WantedDevice> wanted) throws IOException {
        Set<String> users = new HashSet<>(byUser(wanted).keySet());
        if (allowed == null || !users.containsAll(allowed)) {
            allowed = null;
            granted = granted == null
                    ? null
                    : granted.stream()
                            .filter(account -> users.contains(account.login().user()))
                            .toList();
            for (MqttAccounts broker : brokers) {
                broker.retain(users);
            }
        }
        allowed = users;
    }

    /**
     * Lets devices in that the agent knows. While it is still learning of others, none loses its account.
     *
     * @param there by key
     * @param complete whether these are all
     * @return why, by key, of those that cannot have their account
     */
    public Map<String, String> grant(Map<String, WantedDevice> there, boolean complete) throws IOException {
        List<MqttAccount> accounts = List.copyOf(byUser(there.values()).values());
        boolean grows = granted != null && new HashSet<>(accounts).containsAll(granted);
        if (!accounts.equals(granted) && (complete || grows)) {
            granted = null;
            refused = new HashMap<>();
            for (MqttAccounts broker : brokers) {
                refused.putAll(broker.replace(accounts));
            }
            granted = accounts;
        }
        Map<String, String> reasons = new TreeMap<>();
        if (!refused.isEmpty()) {
            there.forEach((key, device) -> byUser(List.of(device)).keySet().stream()
                    .filter(refused::containsKey)
                    .forEach(user -> reasons.put(key, refused.get(user))));
        }
        return reasons;
    }

    private Map<String, MqttAccount> byUser(Collection<WantedDevice> devices) {
        FarmSecret now = secret.get();
        Map<String, MqttAccount> byUser = new TreeMap<>();
        Set<String> missions = new HashSet<>();
        for (WantedDevice device : devices) {
            String mission = device.version().mission();
            MqttAccount.devices(now, mission, device.device(), device.generation())
                    .forEach(account -> byUser.put(account.login().user(), account));
            if (gateways && missions.add(mission)) {
                MqttAccount.gateways(now, mission)
                        .forEach(account -> byUser.put(account.login().user(), account));
            }
        }
        return byUser;
    }
}
