package io.furrow.provisioner.account;

import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.BiPredicate;
import java.util.function.Function;
import java.util.function.LongSupplier;
import java.util.function.Predicate;
import java.util.stream.Collectors;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.FarmSecret;

/**
 * Holds accounts for an MQTT broker in this JVM, which checks each connection and message against them, and records the
 * results. Thread-safe.
 */
public final class InMemoryAccounts implements MqttAccounts, LoginReports {
    private static final Logger LOG = LoggerFactory.getLogger(InMemoryAccounts.class);
    private static final int MAX_UNKNOWN_USERS = 1000;
    private static final int MAX_LOGGED_LENGTH = 200;
    private static final long LOG_EVERY_MS = 10_000;

    private final LongSupplier clock;
    private final LoginHistory owners = new LoginHistory(Integer.MAX_VALUE);
    private final AtomicLong lastLogged = new AtomicLong(Long.MIN_VALUE / 2);
    private final LoginHistory unknownUsers = new LoginHistory(MAX_UNKNOWN_USERS);
    private volatile Map<String, MqttAccount> byUser = Map.of();

    public InMemoryAccounts() {
        this(System::currentTimeMillis);
    }

    /** @param clock epoch ms */
    InMemoryAccounts(LongSupplier clock) {
        this.clock = clock;
    }

    @Override
    public Map<String, String> replace(List<MqttAccount> accounts, Set<String> retained) {
        List<MqttAccount> all = new ArrayList<>(accounts);
        Set<String> users =
                accounts.stream().map(account -> account.login().user()).collect(Collectors.toSet());
        byUser.forEach((user, account) -> {
            if (retained.contains(user) && !users.contains(user)) {
                all.add(account);
            }
        });
        byUser = all.stream()
                .collect(Collectors.toUnmodifiableMap(account -> account.login().user(), Function.identity()));
        owners.retain(byUser.keySet());
        return Map.of();
    }

    @Override
    public Set<String> retain(Set<String> users, BiPredicate<String, Predicate<FarmSecret.Login>> removable) {
        Set<String> retained = byUser.values().stream()
                .map(MqttAccount::login)
                .filter(login -> !users.contains(login.user()) && !removable.test(login.user(), login::equals))
                .map(FarmSecret.Login::user)
                .collect(Collectors.toSet());
        replace(
                byUser.values().stream()
                        .filter(account -> users.contains(account.login().user()))
                        .toList(),
                retained);
        return retained;
    }

    @Override
    public Map<String, LoginReport> reports() {
        Map<String, LoginReport> all = new HashMap<>(unknownUsers.reports());
        all.putAll(owners.reports());
        return all;
    }

    /** Whether the password is that of the user. */
    public boolean authenticates(String user, byte[] password) {
        MqttAccount account = byUser.get(user);
        if (account == null) {
            unknownUsers.refused(user, DeviceConnection.UNKNOWN_USER, clock.getAsLong());
            log("login of an unknown user", user);
            return false;
        }
        boolean valid = MessageDigest.isEqual(account.login().password().getBytes(StandardCharsets.UTF_8), password);
        if (valid) {
            owners.loggedIn(user, clock.getAsLong());
        } else {
            owners.refused(user, DeviceConnection.WRONG_PASSWORD, clock.getAsLong());
            log("login with a wrong password", user);
        }
        return valid;
    }

    public boolean exists(String user) {
        return byUser.containsKey(user);
    }

    /** Whether a user may publish to a topic. */
    public boolean mayWrite(String user, String topic) {
        MqttAccount account = byUser.get(user);
        boolean allowed = account != null && account.mayWrite(topic);
        if (account != null && !allowed) {
            owners.published(user, topic, clock.getAsLong());
            log("message to a topic of somebody else", user);
        }
        return allowed;
    }

    /** Limits rate and length and removes control characters, because any client can cause these lines. */
    private void log(String what, String user) {
        long now = clock.getAsLong();
        long before = lastLogged.get();
        if (now - before >= LOG_EVERY_MS && lastLogged.compareAndSet(before, now)) {
            String name = user.substring(0, Math.min(user.length(), MAX_LOGGED_LENGTH))
                    .replaceAll("\\p{Cntrl}", "?");
            LOG.info("the MQTT broker refused a {}, {}; further ones within 10 s are not logged", what, name);
        }
    }

    /** @param filter of a subscription */
    public boolean mayRead(String user, String filter) {
        MqttAccount account = byUser.get(user);
        return account != null && account.mayRead(filter);
    }
}
