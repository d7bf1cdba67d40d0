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
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;
import io.furrow.provisioner.RemovalGuard.Retained;
import io.furrow.provisioner.account.DeviceAccounts;

/**
 * Reconciles IoT Agent and MQTT brokers with the desired devices, one step at a time. New devices are registered at the
 * agent before they get an account, so that the agent knows every device that can send. Devices that are no longer
 * desired are removed in the opposite order.
 */
final class ProvisioningReconciler {
    private static final Logger LOG = LoggerFactory.getLogger(ProvisioningReconciler.class);
    /** With a last request of ten seconds, a step is still much shorter than {@code max.poll.interval.ms}. */
    static final Duration STEP = Duration.ofSeconds(5);
    /** Minimum time for which the agent's devices must match: during its start it may report that it has none. */
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
    private final Map<FiwareScope, AgentRegistrationCache> caches = new HashMap<>();
    private final Map<AgentRegistration, String> rejectionByRegistration = new HashMap<>();
    private FarmSecret currentSecret;
    private Set<String> registered;
    private boolean secretVerified;
    private RemovalGuard.Origin origin = RemovalGuard.Origin.UNKNOWN;
    private boolean started;
    private boolean settled;
    /** Time of the last refresh, by {@link #nanos}. */
    private long refreshedAt;
    /** Since when all devices at the agent are desired, by {@link #nanos}; null if some are not. */
    private Long settlingSince;

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
     * The result of a step.
     *
     * @param rejected reasons by key of the device
     * @param removalFailure why a device or group that is no longer desired could not be removed; null if none failed
     * @param retained what is not desired but must not be removed; null if nothing
     * @param done whether nothing is left to do, except what was rejected, could not be removed or is retained
     */
    record Outcome(Map<String, String> rejected, String removalFailure, Retained retained, boolean done) {}

    /** Makes the next step read the agent again and retry rejected devices. */
    void refresh() {
        refreshedAt = nanos.getAsLong();
        caches.clear();
        rejectionByRegistration.clear();
        accounts.retryRejected();
        secretVerified = false;
    }

    /** Refreshes, and discards the state of accounts too. */
    void reset(RemovalGuard.Origin newOrigin) {
        refresh();
        registered = null;
        accounts.reset();
        origin = newOrigin;
        started = false;
    }

    /** The origin recorded in the brokers' files takes precedence over the committed offset in Kafka. */
    private void start() throws IOException {
        if (!started) {
            Set<String> recorded = accounts.origins();
            boolean isSameKafka = recorded.isEmpty() ? origin.provisioned() : recorded.equals(Set.of(origin.topic()));
            removals.reset(forgets || isSameKafka);
            started = true;
            settled = false;
            settlingSince = null;
        }
        removals.desired(desired.all().values());
        removals.desired(desired.undecided());
        removals.unreadable(desired.hasUnreadable());
    }

    /** Whether the farm's secret changed since the last step: by rotation, or because an older key expired. */
    boolean isSecretChanged() {
        return !secret.get().equals(currentSecret);
    }

    /**
     * Executes one step: at most a batch of devices in each scope, without starting requests after {@link #STEP}.
     *
     * @throws IOException if the agent or a broker is unavailable or denies access, or the secret is not the farm's
     */
    Outcome step() throws IOException, InterruptedException {
        if (!secretVerified) {
            secret.verify();
            secretVerified = true;
        }
        FarmSecret now = secret.get();
        if (!now.equals(currentSecret)) {
            LOG.info("the MQTT brokers must accept passwords of the keys {} of the farm's secret", now.acceptedKeys());
        }
        currentSecret = now;
        start();
        List<DesiredDevice> spared = new ArrayList<>(desired.undecided());
        spared.addAll(desired.all().values());
        accounts.revoke(spared, removals.allowsAll());
        Map<String, String> rejected = new TreeMap<>();
        Map<String, AgentRegistration> present = new LinkedHashMap<>();
        TimeBudget budget = new TimeBudget(STEP, nanos);
        boolean added = true;
        for (FiwareScope scope : desired.scopes()) {
            added &= add(scope, budget, present, rejected);
        }
        Map<String, DesiredDevice> existing = new LinkedHashMap<>();
        present.keySet().forEach(key -> existing.put(key, desired.all().get(key)));
        rejected.putAll(accounts.grant(existing, added));
        desired.provisioned(present.keySet());
        registered = Set.copyOf(present.keySet());
        boolean removed = true;
        String removalFailure = null;
        List<String> retainedDevices = new ArrayList<>();
        List<String> retainedGroups = new ArrayList<>();
        for (FiwareScope scope : desired.scopes()) {
            if (AgentRegistrationFactory.hasTenant(scope)) {
                String failure = remove(scope, budget);
                removalFailure = failure == null ? removalFailure : failure;
                removed &= failure != null || isClean(scope);
                Retained ofScope = cacheOf(scope).retained(desiredKeys(scope));
                retainedDevices.addAll(ofScope.devices());
                retainedGroups.addAll(ofScope.groups());
            }
        }
        Retained retained = new Retained(accounts.retained(), retainedDevices, retainedGroups);
        boolean done = added && removed;
        if (!retained.isEmpty()) {
            settlingSince = null;
        } else if (done && !present.isEmpty()) { // an empty agent proves nothing about this Kafka
            settle();
        }
        return new Outcome(rejected, removalFailure, retained.isEmpty() ? null : retained, done);
    }

    private void settle() throws IOException {
        if (settlingSince == null) {
            settlingSince = nanos.getAsLong();
        } else if (!settled && refreshedAt - settlingSince >= AGREEMENT.toNanos()) {
            accounts.recordOrigin(origin.topic());
            removals.allowAll();
            settled = true;
        }
    }

    /** Returns the keys of the devices that the agent had at the last step; null before the first. */
    Set<String> registered() {
        return registered;
    }

    /** Whether agent and brokers are known to belong to this Kafka. */
    boolean isSettled() {
        return settled;
    }

    private boolean add(
            FiwareScope scope, TimeBudget budget, Map<String, AgentRegistration> present, Map<String, String> rejected)
            throws IOException, InterruptedException {
        Map<AgentRegistration, String> missing = new LinkedHashMap<>();
        for (Map.Entry<String, DesiredDevice> each : in(scope).entrySet()) {
            try {
                AgentRegistration registration = registrations.of(each.getValue());
                if (cacheOf(scope).has(registration)) {
                    present.put(each.getKey(), registration);
                } else if (rejectionByRegistration.containsKey(registration)) {
                    rejected.put(each.getKey(), rejectionByRegistration.get(registration));
                } else {
                    missing.put(registration, each.getKey());
                }
            } catch (RejectedByAgentException e) {
                rejected.put(each.getKey(), e.getMessage());
            }
        }
        List<AgentRegistration> batch =
                missing.keySet().stream().limit(batchSize.current()).toList();
        if (batch.isEmpty()) {
            return true;
        }
        rejectionByRegistration.putAll(add(cacheOf(scope), batch, budget));
        int settled = 0;
        for (AgentRegistration device : batch) {
            if (rejectionByRegistration.containsKey(device)) {
                rejected.put(missing.get(device), rejectionByRegistration.get(device));
                settled++;
            } else if (cacheOf(scope).has(device)) {
                present.put(missing.get(device), device);
                settled++;
            }
        }
        return settled == missing.size();
    }

    private Map<AgentRegistration, String> add(
            AgentRegistrationCache cache, List<AgentRegistration> batch, TimeBudget budget)
            throws IOException, InterruptedException {
        try {
            Map<AgentRegistration, String> rejected = cache.add(batch, budget);
            batchSize.succeeded();
            return rejected;
        } catch (IOException e) {
            batchSize.failed();
            throw e;
        }
    }

    private String remove(FiwareScope scope, TimeBudget budget) throws IOException, InterruptedException {
        return cacheOf(scope).remove(desiredDevices(scope), desiredKeys(scope), budget);
    }

    private boolean isClean(FiwareScope scope) throws IOException, InterruptedException {
        return cacheOf(scope).isClean(desiredDevices(scope), desiredKeys(scope));
    }

    private Set<String> desiredDevices(FiwareScope scope) {
        return desiredOrUndecided(scope).map(DesiredDevice::device).collect(Collectors.toSet());
    }

    private Set<String> desiredKeys(FiwareScope scope) {
        return desiredOrUndecided(scope)
                .map(device -> secret.get().apiKey(device.version().mission()))
                .collect(Collectors.toSet());
    }

    private Stream<DesiredDevice> desiredOrUndecided(FiwareScope scope) {
        return Stream.concat(
                in(scope).values().stream(),
                desired.undecided().stream()
                        .filter(device -> DesiredDeviceTable.scope(device).equals(scope)));
    }

    private AgentRegistrationCache cacheOf(FiwareScope scope) throws IOException, InterruptedException {
        AgentRegistrationCache cache = caches.get(scope);
        if (cache == null) {
            try {
                cache = AgentRegistrationCache.read(agent, scope, registrations, removals);
            } catch (RejectedByAgentException e) {
                throw new IOException(e.getMessage(), e);
            }
            caches.put(scope, cache);
        }
        return cache;
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
