package io.furrow.provisioner;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.BiPredicate;
import java.util.function.LongSupplier;
import java.util.function.Predicate;
import java.util.stream.Collectors;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;
import io.furrow.provisioner.ProvisioningReconciler.Outcome;
import io.furrow.provisioner.account.InMemoryAccounts;
import io.furrow.provisioner.account.MqttAccount;
import io.furrow.provisioner.account.MqttAccounts;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Runs a provisioner with desired devices, an agent and accounts under the control of a test. */
abstract class ProvisioningFixture {
    static final Outcome DONE = new Outcome(Map.of(), null, null, true);
    /** The Kafka whose devices were provisioned before. */
    static final RemovalGuard.Origin SAME_KAFKA = new RemovalGuard.Origin("topic-1", true);

    static final String KEY = DesiredDeviceFixture.SECRET.apiKey("hoeing");

    final DesiredDeviceTable desired = new DesiredDeviceTable(DesiredDeviceFixture.SCOPE);
    final InMemoryAccounts accounts = new InMemoryAccounts();
    /** Number of accounts after each change. */
    final List<Integer> counts = new ArrayList<>();

    final Map<String, String> rejected = new HashMap<>();
    /** Offset to the system clock. */
    final AtomicLong elapsed = new AtomicLong();

    LongSupplier clock = () -> System.nanoTime() + elapsed.get();

    @AutoClose
    FakeAgent agent;

    ProvisioningReconciler provisioning;

    @BeforeEach
    void start() throws IOException {
        agent = new FakeAgent();
        provisioning = provisioning();
    }

    ProvisioningReconciler provisioning() {
        return provisioning(settings(SecretSource.of(DesiredDeviceFixture.SECRET), false), SAME_KAFKA);
    }

    ProvisioningReconciler provisioning(ProvisioningSettings settings, RemovalGuard.Origin origin) {
        ProvisioningReconciler started = new ProvisioningReconciler(settings, desired, () -> clock.getAsLong());
        started.reset(origin);
        return started;
    }

    ProvisioningSettings settings(SecretSource secret, boolean gateways) {
        return new ProvisioningSettings(
                new Properties(),
                DesiredDeviceFixture.SCOPE,
                secret,
                AgentSettings.at(agent.uri()),
                List.of(accounts, new Counted()),
                gateways);
    }

    void addDesired(DesiredDevice device) {
        desired.take(device.version().key(), device);
    }

    /** Refreshes, and advances the time so that an unchanged answer of the agent counts. */
    void stepLater() {
        elapsed.addAndGet(ProvisioningReconciler.AGREEMENT.toNanos());
        provisioning.refresh();
    }

    boolean authenticates(FarmSecret.Login login) {
        return accounts.authenticates(login.user(), login.password().getBytes(UTF_8));
    }

    /** Counts accounts at each change, and rejects foreign users. */
    private final class Counted implements MqttAccounts {
        private final Set<String> users = new HashSet<>();

        @Override
        public Map<String, String> replace(List<MqttAccount> all, Set<String> retained) {
            users.retainAll(retained);
            all.forEach(account -> users.add(account.login().user()));
            counts.add(users.size());
            return Map.copyOf(rejected);
        }

        @Override
        public Set<String> retain(Set<String> some, BiPredicate<String, Predicate<FarmSecret.Login>> removable) {
            if (users.removeIf(user -> !some.contains(user) && removable.test(user, any -> true))) {
                counts.add(users.size());
            }
            return users.stream().filter(user -> !some.contains(user)).collect(Collectors.toSet());
        }
    }
}
