package io.furrow.control.provisioning;

import java.io.IOException;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.FiwareScope;

/**
 * Brings IoT Agent and MQTT brokers in line with the wanted devices, a step at a time. New devices: first the agent, so that it
 * knows whose measure it gets, then the accounts, without which no measure comes. Unwanted ones: the other way round.
 */
final class Provisioning {
    private final AgentClient agent;
    private final Registrations registrations;
    private final FarmSecret secret;
    private final List<MqttAccounts> brokers;
    private final WantedDevices wanted;
    private final Map<FiwareScope, AgentBook> books = new HashMap<>();
    private final Map<Registration, String> held = new HashMap<>();
    private List<MqttAccount> known;

    Provisioning(ProvisioningSettings settings, WantedDevices wanted) {
        this.agent = new AgentClient(settings.iotAgent());
        this.registrations = new Registrations(settings.secret());
        this.secret = settings.secret();
        this.brokers = settings.accounts();
        this.wanted = wanted;
    }

    /**
     * What came of a step.
     *
     * @param refused why, by key of the device
     * @param done whether nothing is left to be done but what was refused
     */
    record Outcome(Map<String, String> refused, boolean done) {}

    /** Asks the agent again before the next step, and offers it again what it has refused. */
    void lookAgain() {
        books.clear();
        held.clear();
    }

    /** The same, and takes nothing of the accounts for granted. */
    void startAnew() {
        lookAgain();
        known = null;
    }

    /**
     * Does some of what is to be done: at most a batch of devices in each scope.
     *
     * @throws IOException if the agent or a broker is away, or does not let itself be asked
     */
    Outcome step() throws IOException, InterruptedException {
        Map<String, String> refused = new TreeMap<>();
        Map<String, Registration> there = new LinkedHashMap<>();
        boolean added = true;
        for (FiwareScope scope : wanted.scopes()) {
            added &= add(scope, there, refused);
        }
        account(there.values(), added);
        wanted.provisioned(there.keySet());
        boolean removed = true;
        for (FiwareScope scope : wanted.scopes()) {
            removed &= remove(scope);
        }
        boolean done = added && removed;
        return new Outcome(refused, done);
    }

    private boolean add(FiwareScope scope, Map<String, Registration> there, Map<String, String> refused)
            throws IOException, InterruptedException {
        AgentBook book = book(scope);
        Map<Registration, String> missing = new LinkedHashMap<>();
        for (Map.Entry<String, WantedDevice> each : in(scope).entrySet()) {
            try {
                Registration registration = registrations.of(each.getValue());
                if (book.has(registration)) {
                    there.put(each.getKey(), registration);
                } else if (held.containsKey(registration)) {
                    refused.put(each.getKey(), held.get(registration));
                } else {
                    missing.put(registration, each.getKey());
                }
            } catch (RefusedByAgentException e) {
                refused.put(each.getKey(), e.getMessage());
            }
        }
        List<Registration> batch =
                missing.keySet().stream().limit(AgentBook.BATCH).toList();
        held.putAll(book.add(batch));
        for (Registration device : batch) {
            if (held.containsKey(device)) {
                refused.put(missing.get(device), held.get(device));
            } else {
                there.put(missing.get(device), device);
            }
        }
        return batch.size() == missing.size();
    }

    /** While the agent is still learning of devices, none loses an account that it has. */
    private void account(Collection<Registration> there, boolean complete) throws IOException {
        Map<String, MqttAccount> byUser = new TreeMap<>();
        for (Registration device : there) {
            MqttAccount own = MqttAccount.device(secret, device.mission(), device.device());
            byUser.put(own.login().user(), own);
            byUser.computeIfAbsent(device.mission(), mission -> MqttAccount.gateway(secret, mission));
        }
        List<MqttAccount> accounts = List.copyOf(byUser.values());
        boolean grows = known != null && new HashSet<>(accounts).containsAll(known);
        if (accounts.equals(known) || !complete && !grows) {
            return;
        }
        known = null;
        for (MqttAccounts broker : brokers) {
            broker.replace(accounts);
        }
        known = accounts;
    }

    private boolean remove(FiwareScope scope) throws IOException, InterruptedException {
        Set<String> devices = new HashSet<>();
        Set<String> apiKeys = new HashSet<>();
        for (WantedDevice device : in(scope).values()) {
            devices.add(device.device());
            apiKeys.add(secret.apiKey(device.version().mission()));
        }
        AgentBook book = book(scope);
        try {
            book.remove(devices, apiKeys);
        } catch (RefusedByAgentException e) {
            throw new IOException("what is no longer wanted stays: " + e.getMessage(), e);
        }
        return book.isClean(devices, apiKeys);
    }

    private AgentBook book(FiwareScope scope) throws IOException, InterruptedException {
        AgentBook book = books.get(scope);
        if (book == null) {
            try {
                book = AgentBook.open(agent, scope, registrations);
            } catch (RefusedByAgentException e) {
                throw new IOException(e.getMessage(), e);
            }
            books.put(scope, book);
        }
        return book;
    }

    private Map<String, WantedDevice> in(FiwareScope scope) {
        Map<String, WantedDevice> devices = new LinkedHashMap<>();
        wanted.all().forEach((key, device) -> {
            if (WantedDevices.scope(device).equals(scope)) {
                devices.put(key, device);
            }
        });
        return devices;
    }
}
