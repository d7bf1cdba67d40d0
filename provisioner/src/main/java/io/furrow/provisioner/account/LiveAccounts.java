package io.furrow.provisioner.account;

import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.function.Function;
import java.util.stream.Collectors;

/** Accounts for an MQTT broker in this JVM, which asks at each connection and message. Safe from all threads. */
public final class LiveAccounts implements MqttAccounts {
    private volatile Map<String, MqttAccount> byUser = Map.of();

    @Override
    public Map<String, String> replace(List<MqttAccount> accounts) {
        byUser = accounts.stream()
                .collect(Collectors.toUnmodifiableMap(account -> account.login().user(), Function.identity()));
        return Map.of();
    }

    @Override
    public void retain(Set<String> users) {
        replace(byUser.values().stream()
                .filter(account -> users.contains(account.login().user()))
                .toList());
    }

    public boolean knows(String user, byte[] password) {
        MqttAccount account = byUser.get(user);
        return account != null
                && MessageDigest.isEqual(account.login().password().getBytes(StandardCharsets.UTF_8), password);
    }

    public boolean exists(String user) {
        return byUser.containsKey(user);
    }

    public boolean mayWrite(String user, String topic) {
        MqttAccount account = byUser.get(user);
        return account != null && account.mayWrite(topic);
    }

    /** @param filter of a subscription */
    public boolean mayRead(String user, String filter) {
        MqttAccount account = byUser.get(user);
        return account != null && account.mayRead(filter);
    }
}
