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

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;

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
    /** Whose accounts this Kafka has asked for since the start: devices and missions. */
    private final Set<String> own = new HashSet<>();
    /** Users that nothing asks for and that may not be removed. */
    private final Set<String> retained = new TreeSet<>();

    private Map<String, String> refused = Map.of();

    /** @param gateways whether each mission has an account that may speak for all its devices */
    public DeviceAccounts(List<MqttAccounts> brokers, SecretSource secret, boolean gateways) {
        this.brokers = brokers;
        this.secret = secret;
        this.gateways = gateways;
    }

    /** Takes nothing for granted: another process may have been at work. */
    public void startAnew() {
        granted = null;
        allowed = null;
        own.clear();
        retained.clear();
    }

    /** The ids of the topics whose devices the brokers' accounts are noted to be of. */
    public Set<String> origins() throws IOException {
        Set<String> origins = new HashSet<>();
        for (MqttAccounts broker : brokers) {
            broker.origin().ifPresent(origins::add);
        }
        return origins;
    }

    /** Notes that all accounts are of devices of a topic. @param topic its id; empty if it is not known */
    public void noteOrigin(String topic) throws IOException {
        for (MqttAccounts broker : topic.isEmpty() ? List.<MqttAccounts>of() : brokers) {
            broker.noteOrigin(topic);
        }
    }

    /** Users that nothing asks for and that may not be removed. */
    public Set<String> retained() {
        return Set.copyOf(retained);
    }

    /** Tries those again that a broker has refused. */
    public void retryRefused() {
        if (!refused.isEmpty()) {
            granted = null;
        }
        if (!retained.isEmpty()) {
            allowed = null;
        }
    }

    /**
     * Removes the accounts that none of the desired devices has any more.
     *
     * @param all whether those too that no desired device has had since the start, and whose key is accepted
     */
    public void revoke(Collection<DesiredDevice> desired, boolean all) throws IOException {
        Set<String> users = new HashSet<>(byUser(desired).keySet());
        users.forEach(user -> own.add(UserName.of(user).owner()));
        if (allowed == null || !users.containsAll(allowed)) {
            allowed = null;
            granted = granted == null
                    ? null
                    : granted.stream()
                            .filter(account -> users.contains(account.login().user()))
                            .toList();
            retained.clear();
            for (MqttAccounts broker : brokers) {
                retained.addAll(broker.retain(users, user -> all || mayGo(UserName.of(user))));
            }
        }
        retained.removeAll(users);
        allowed = users;
    }

    private boolean mayGo(UserName user) {
        return own.contains(user.owner()) || !secret.get().acceptedKeys().contains(user.key());
    }

    /**
     * Lets devices in that the agent knows. A desired device that the agent does not know, or no longer, does not lose its account.
     *
     * @param there by key
     * @param complete whether these are all
     * @return why, by key, of those that cannot have their account
     */
    public Map<String, String> grant(Map<String, DesiredDevice> there, boolean complete) throws IOException {
        List<MqttAccount> accounts = List.copyOf(byUser(there.values()).values());
        boolean grows = granted != null && new HashSet<>(accounts).containsAll(granted);
        if (!accounts.equals(granted) && (complete || grows)) {
            granted = null;
            refused = new HashMap<>();
            Set<String> retain = new HashSet<>(retained);
            retain.addAll(allowed);
            accounts.forEach(account -> retain.remove(account.login().user()));
            for (MqttAccounts broker : brokers) {
                refused.putAll(broker.replace(accounts, retain));
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
