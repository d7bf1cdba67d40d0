package io.furrow.provisioner;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.LongSupplier;
import java.util.stream.Collectors;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;
import io.furrow.provisioner.RemovalGuard.Retained;
import io.furrow.provisioner.account.DeviceAccounts;

/**
 * Reconciles IoT Agent and MQTT brokers with the desired devices, one step at a time. New devices: first the agent, so
 * that it knows whose measure it gets, then the accounts, without which no measure comes. Unwanted ones: the other way
 * round.
 */
final class ProvisioningReconciler {
    private static final Logger LOG = LoggerFactory.getLogger(ProvisioningReconciler.class);
    /** With a request that takes its ten seconds at the end this is far from the consumer's {@code max.poll.interval.ms}. */
    static final Duration STEP = Duration.ofSeconds(5);
    /** One answer of the agent proves nothing: while it starts it may say that it has no devices. */
    static final Duration AGREEMENT = Duration.ofSeconds(10);

    private final AgentClient agent;
    private final AgentRegistrationFactory registrations;
    private final SecretSource secret;
    private final DeviceAccounts accounts;
    private final DesiredDeviceTable desired;
    private final LongSupplier nanos;
    private final boolean forgets;
    private final BatchSize batchSize = new BatchSize();
    private final RemovalGuard removals = new RemovalGuard();
    private final Map<FiwareScope, AgentRegistrationCache> registries = new HashMap<>();
    private final Map<AgentRegistration, String> rejected = new HashMap<>();
    private FarmSecret used;
    private Set<String> registered;
    private boolean verified;
    private RemovalGuard.Origin origin = RemovalGuard.Origin.UNKNOWN;
    private boolean started;
    private boolean settled;
    /** When the agent was last asked, by {@link #nanos}. */
    private long refreshedAt;
    /** Since when all that the agent says that it has is wanted, by {@link #nanos}; null while it is not so. */
    private Long agreed;

    ProvisioningReconciler(ProvisioningSettings settings, DesiredDeviceTable desired, LongSupplier nanos) {
        this.agent = new AgentClient(settings.agent());
        this.registrations = new AgentRegistrationFactory(settings.secret());
        this.secret = settings.secret();
        this.accounts = new DeviceAccounts(settings.accounts(), settings.secret(), settings.gateways());
        this.forgets = settings.forgets();
        this.desired = desired;
        this.nanos = nanos;
        this.refreshedAt = nanos.getAsLong();
    }

    /**
     * What came of a step.
     *
     * @param refused why, by key of the device
     * @param stuck why something that is no longer wanted could not be removed; null if nothing was in the way
     * @param retained what is not wanted and may not be removed; null for nothing
     * @param done whether nothing is left to be done but what was refused, is stuck or kept
     */
    record Outcome(Map<String, String> refused, String stuck, Retained retained, boolean done) {}

    /** Asks the agent again before the next step, and offers it again what it has refused. */
    void refresh() {
        refreshedAt = nanos.getAsLong();
        registries.clear();
        rejected.clear();
        accounts.retryRefused();
        verified = false;
    }

    /** The same, and takes nothing of the accounts for granted. */
    void startAnew(RemovalGuard.Origin newOrigin) {
        refresh();
        registered = null;
        accounts.startAnew();
        origin = newOrigin;
        started = false;
    }

    /** What the brokers' files say of it counts more than what Kafka says of itself. */
    private void start() throws IOException {
        if (!started) {
            Set<String> recorded = accounts.origins();
            boolean same = recorded.isEmpty() ? origin.provisioned() : recorded.equals(Set.of(origin.topic()));
            removals.startAnew(forgets || same);
            started = true;
            settled = false;
            agreed = null;
        }
        removals.desired(desired.all().values());
    }

    /** Whether the farm's secret is another than at the last step: it was rotated, or the time of an older key is over. */
    boolean isSecretChanged() {
        return !secret.get().equals(used);
    }

    /**
     * Does some of what is to be done: at most a batch of devices in each scope, and begins no request after {@link #STEP}.
     *
     * @throws IOException if the agent or a broker is unavailable, or does not let itself be asked, or the secret is not the farm's
     */
    Outcome step() throws IOException, InterruptedException {
        if (!verified) {
            secret.verify();
            verified = true;
        }
        FarmSecret now = secret.get();
        if (!now.equals(used)) {
            LOG.info("the MQTT brokers must accept passwords of the keys {} of the farm's secret", now.acceptedKeys());
        }
        used = now;
        start();
        accounts.revoke(desired.all().values(), removals.allowsAll());
        Map<String, String> refused = new TreeMap<>();
        Map<String, AgentRegistration> there = new LinkedHashMap<>();
        TimeBudget budget = new TimeBudget(STEP, nanos);
        boolean added = true;
        for (FiwareScope scope : desired.scopes()) {
            added &= add(scope, budget, there, refused);
        }
        Map<String, DesiredDevice> existing = new LinkedHashMap<>();
        there.keySet().forEach(key -> existing.put(key, desired.all().get(key)));
        refused.putAll(accounts.grant(existing, added));
        desired.provisioned(there.keySet());
        registered = Set.copyOf(there.keySet());
        boolean removed = true;
        String stuck = null;
        List<String> retainedDevices = new ArrayList<>();
        List<String> retainedGroups = new ArrayList<>();
        for (FiwareScope scope : desired.scopes()) {
            if (AgentRegistrationFactory.hasTenant(scope)) {
                String failure = remove(scope, budget);
                stuck = failure == null ? stuck : failure;
                removed &= failure != null || isClean(scope);
                Retained here = registry(scope).retained(desiredKeys(scope));
                retainedDevices.addAll(here.devices());
                retainedGroups.addAll(here.groups());
            }
        }
        Retained retained = new Retained(accounts.retained(), retainedDevices, retainedGroups);
        boolean done = added && removed;
        if (!retained.isEmpty()) {
            agreed = null;
        } else if (done && !there.isEmpty()) { // an agent that has nothing says nothing of this Kafka
            settle();
        }
        return new Outcome(refused, stuck, retained.isEmpty() ? null : retained, done);
    }

    private void settle() throws IOException {
        if (agreed == null) {
            agreed = nanos.getAsLong();
        } else if (!settled && refreshedAt - agreed >= AGREEMENT.toNanos()) {
            accounts.noteOrigin(origin.topic());
            removals.allowAll();
            settled = true;
        }
    }

    /** Keys of the devices that the agent had at the last step; null before the first. */
    Set<String> registered() {
        return registered;
    }

    /** Whether all that is there is wanted, or may be removed: this Kafka is the one of which it is. */
    boolean isSettled() {
        return settled;
    }

    private boolean add(
            FiwareScope scope, TimeBudget budget, Map<String, AgentRegistration> there, Map<String, String> refused)
            throws IOException, InterruptedException {
        Map<AgentRegistration, String> missing = new LinkedHashMap<>();
        for (Map.Entry<String, DesiredDevice> each : in(scope).entrySet()) {
            try {
                AgentRegistration registration = registrations.of(each.getValue());
                if (registry(scope).has(registration)) {
                    there.put(each.getKey(), registration);
                } else if (rejected.containsKey(registration)) {
                    refused.put(each.getKey(), rejected.get(registration));
                } else {
                    missing.put(registration, each.getKey());
                }
            } catch (RejectedByAgentException e) {
                refused.put(each.getKey(), e.getMessage());
            }
        }
        List<AgentRegistration> batch =
                missing.keySet().stream().limit(batchSize.current()).toList();
        if (batch.isEmpty()) {
            return true;
        }
        rejected.putAll(add(registry(scope), batch, budget));
        int settled = 0;
        for (AgentRegistration device : batch) {
            if (rejected.containsKey(device)) {
                refused.put(missing.get(device), rejected.get(device));
                settled++;
            } else if (registry(scope).has(device)) {
                there.put(missing.get(device), device);
                settled++;
            }
        }
        return settled == missing.size();
    }

    private Map<AgentRegistration, String> add(
            AgentRegistrationCache registry, List<AgentRegistration> batch, TimeBudget budget)
            throws IOException, InterruptedException {
        try {
            Map<AgentRegistration, String> refused = registry.add(batch, budget);
            batchSize.succeeded();
            return refused;
        } catch (IOException e) {
            batchSize.failed();
            throw e;
        }
    }

    private String remove(FiwareScope scope, TimeBudget budget) throws IOException, InterruptedException {
        return registry(scope).remove(desiredDevices(scope), desiredKeys(scope), budget);
    }

    private boolean isClean(FiwareScope scope) throws IOException, InterruptedException {
        return registry(scope).isClean(desiredDevices(scope), desiredKeys(scope));
    }

    private Set<String> desiredDevices(FiwareScope scope) {
        return in(scope).values().stream().map(DesiredDevice::device).collect(Collectors.toSet());
    }

    private Set<String> desiredKeys(FiwareScope scope) {
        return in(scope).values().stream()
                .map(device -> secret.get().apiKey(device.version().mission()))
                .collect(Collectors.toSet());
    }

    private AgentRegistrationCache registry(FiwareScope scope) throws IOException, InterruptedException {
        AgentRegistrationCache registry = registries.get(scope);
        if (registry == null) {
            try {
                registry = AgentRegistrationCache.read(agent, scope, registrations, removals);
            } catch (RejectedByAgentException e) {
                throw new IOException(e.getMessage(), e);
            }
            registries.put(scope, registry);
        }
        return registry;
    }

    private Map<String, DesiredDevice> in(FiwareScope scope) {
        Map<String, DesiredDevice> devices = new LinkedHashMap<>();
        desired.all().forEach((key, device) -> {
            if (DesiredDeviceTable.scope(device).equals(scope)) {
                devices.put(key, device);
            }
        });
        return devices;
    }
}
