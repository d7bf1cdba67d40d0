package io.furrow.provisioner.account;

import java.io.IOException;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.function.Predicate;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;

/**
 * Manages the accounts of devices at the MQTT brokers. Revoked accounts, for instance of a stolen device, are removed
 * even if the IoT Agent is unavailable; an account is granted only after the agent has registered the device.
 */
public final class DeviceAccounts {
    private final List<MqttAccounts> brokers;
    private final SecretSource secret;
    private final boolean gateways;
    /** Accounts that all brokers have; null if unknown. */
    private List<MqttAccount> granted;

    private Set<String> allowed;
    /** Devices and missions for which this Kafka has requested accounts since the start. */
    private final Set<String> own = new HashSet<>();
    /** Users that are not desired but must not be removed. */
    private final Set<String> retained = new TreeSet<>();

    private Map<String, String> rejected = Map.of();

    /** @param gateways whether each mission has an account for all of its devices */
    public DeviceAccounts(List<MqttAccounts> brokers, SecretSource secret, boolean gateways) {
        this.brokers = brokers;
        this.secret = secret;
        this.gateways = gateways;
    }

    /** Discards the cached state, because another process may have changed the accounts. */
    public void reset() {
        granted = null;
        allowed = null;
        own.clear();
        retained.clear();
    }

    /** Returns the ids of the topics whose devices have the accounts, as recorded at the brokers. */
    public Set<String> origins() throws IOException {
        Set<String> origins = new HashSet<>();
        for (MqttAccounts broker : brokers) {
            broker.origin().ifPresent(origins::add);
        }
        return origins;
    }

    /** Records the topic whose devices have all accounts. @param topic its id; empty if unknown */
    public void recordOrigin(String topic) throws IOException {
        for (MqttAccounts broker : topic.isEmpty() ? List.<MqttAccounts>of() : brokers) {
            broker.recordOrigin(topic);
        }
    }

    /** Returns the users that are not desired but must not be removed. */
    public Set<String> retained() {
        return Set.copyOf(retained);
    }

    /** Makes the next step retry accounts that a broker has rejected. */
    public void retryRejected() {
        if (!rejected.isEmpty()) {
            granted = null;
        }
        if (!retained.isEmpty()) {
            allowed = null;
        }
    }

    /**
     * Removes the accounts that no desired device has.
     *
     * @param all whether to remove also accounts that no desired device has had since the start and whose key has
     *     not expired
     */
    public void revoke(Collection<DesiredDevice> desired, boolean all) throws IOException {
        Set<String> users = new HashSet<>(byUser(desired).keySet());
        users.forEach(user -> own.add(UserName.of(user).owner()));
        boolean shrinks = allowed == null || !users.containsAll(allowed);
        if (shrinks || all && !retained.isEmpty()) {
            allowed = null;
            granted = granted == null
                    ? null
                    : granted.stream()
                            .filter(account -> users.contains(account.login().user()))
                            .toList();
            retained.clear();
            for (MqttAccounts broker : brokers) {
                retained.addAll(broker.retain(users, (user, isLogin) -> all || isRemovable(user, isLogin)));
            }
        }
        retained.removeAll(users);
        allowed = users;
    }

    /** An account with an expired key is of this farm if its password is; that of another key may be of another farm. */
    private boolean isRemovable(String user, Predicate<FarmSecret.Login> isLogin) {
        return own.contains(UserName.of(user).owner())
                || secret.get()
                        .expired(user, UserName.of(user).key())
                        .filter(isLogin)
                        .isPresent();
    }

    /**
     * Grants accounts to devices that the agent has. A desired device that the agent lacks retains its account.
     *
     * @param registered devices that the agent has, by key
     * @param complete whether these are all desired devices
     * @return the reason, by key, for each device that cannot have its account
     */
    public Map<String, String> grant(Map<String, DesiredDevice> registered, boolean complete) throws IOException {
        List<MqttAccount> accounts = List.copyOf(byUser(registered.values()).values());
        boolean onlyAdditions = granted != null && new HashSet<>(accounts).containsAll(granted);
        if (!accounts.equals(granted) && (complete || onlyAdditions)) {
            granted = null;
            rejected = new HashMap<>();
            Set<String> retain = new HashSet<>(retained);
            retain.addAll(allowed);
            accounts.forEach(account -> retain.remove(account.login().user()));
            for (MqttAccounts broker : brokers) {
                rejected.putAll(broker.replace(accounts, retain));
            }
            granted = accounts;
        }
        Map<String, String> reasons = new TreeMap<>();
        if (!rejected.isEmpty()) {
            registered.forEach((key, device) -> byUser(List.of(device)).keySet().stream()
                    .filter(rejected::containsKey)
                    .forEach(user -> reasons.put(key, rejected.get(user))));
        }
        return reasons;
    }

    private Map<String, MqttAccount> byUser(Collection<DesiredDevice> devices) {
        FarmSecret now = secret.get();
        Map<String, MqttAccount> byUser = new TreeMap<>();
        Set<String> missions = new HashSet<>();
        for (DesiredDevice device : devices) {
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
