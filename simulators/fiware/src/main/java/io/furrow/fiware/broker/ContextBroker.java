package io.furrow.fiware.broker;

import java.time.Clock;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeSet;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicLong;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.fiware.broker.EntityUpdate.Action;
import io.furrow.fiware.http.Correlator;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.PathFilter;
import io.furrow.model.event.FiwareScope;

/** Stores the entities of all tenants and notifies matching subscriptions of changes. */
public final class ContextBroker {
    /** Receives updates of command attributes instead of the entity, as the provider of a registration at Orion does. */
    public interface Commands {
        /** The names of the commands of an entity. */
        Set<String> of(FiwareScope scope, String entityId, Optional<String> type);

        void issue(FiwareScope scope, String entityId, Map<String, JsonNode> commands) throws NgsiError;
    }

    private final Map<String, Tenant> tenants = new ConcurrentHashMap<>();
    private final Notifier notifier;
    private final Commands commands;
    private final Clock clock;
    private final AtomicLong revision;

    /** @param revision incremented with every change of an entity or subscription */
    public ContextBroker(Notifier notifier, Commands commands, Clock clock, AtomicLong revision) {
        this.notifier = notifier;
        this.commands = commands;
        this.clock = clock;
        this.revision = revision;
    }

    public Tenant tenant(String service) {
        return tenants.computeIfAbsent(service, name -> new Tenant(revision));
    }

    public Map<String, Tenant> tenants() {
        return Collections.unmodifiableMap(tenants);
    }

    public Subscription subscribe(String service, String id, PathFilter paths, SubscriptionDefinition definition) {
        Subscription subscription = new Subscription(id, paths, definition, revision);
        tenant(service).add(subscription);
        return subscription;
    }

    /** The current time in milliseconds, the resolution of the context broker. */
    public Instant now() {
        return clock.instant().truncatedTo(ChronoUnit.MILLIS);
    }

    public void create(FiwareScope scope, EntityUpdate request, Correlator correlator) throws NgsiError {
        SyntaxRules.checkNames(request);
        Tenant tenant = tenant(scope.service());
        Optional<String> type = Optional.of(request.type().orElse(EntityUpdate.DEFAULT_TYPE));
        synchronized (tenant) {
            if (!tenant.find(scope.servicePath(), request.id(), type).isEmpty()) {
                throw NgsiError.exists();
            }
            commit(tenant, EntityChange.create(scope, request, now()), correlator);
        }
    }

    /** Appends to the entity, or creates it. */
    public void upsert(FiwareScope scope, EntityUpdate request, boolean forced, Correlator correlator)
            throws NgsiError {
        Tenant tenant = tenant(scope.service());
        synchronized (tenant) {
            if (tenant.find(scope.servicePath(), request.id(), request.type()).isEmpty()) {
                create(scope, request, correlator);
            } else {
                update(scope, request, Action.APPEND, forced, correlator);
            }
        }
    }

    /**
     * Changes an existing entity. Refused attributes are reported after the others are changed. A device has an entity,
     * which accepts commands, after its first measure.
     *
     * @param forced notify also without changes
     * @throws NgsiError 404, 409 or 422, as Orion
     */
    public void update(FiwareScope scope, EntityUpdate request, Action action, boolean forced, Correlator correlator)
            throws NgsiError {
        SyntaxRules.checkNames(request);
        Tenant tenant = tenant(scope.service());
        single(tenant.find(scope.servicePath(), request.id(), request.type()));
        Map<String, AttributeInput> own = new LinkedHashMap<>(request.attributes());
        Map<String, JsonNode> issued = commandsIn(scope, request, action, own);
        if (!issued.isEmpty()) {
            commands.issue(scope, request.id(), issued);
            if (own.isEmpty()) {
                return;
            }
        }
        synchronized (tenant) {
            StoredEntity before = single(tenant.find(scope.servicePath(), request.id(), request.type()));
            Set<String> refused = refused(before, own.keySet(), action);
            own.keySet().removeAll(refused);
            if (!own.isEmpty() || refused.isEmpty()) {
                commit(tenant, change(before, own, action, forced), correlator);
            }
            if (!refused.isEmpty()) {
                NgsiError refusal = NgsiError.noAttributes(request.label(), refused);
                throw own.isEmpty() ? refusal : NgsiError.partial(refusal.getMessage());
            }
        }
    }

    public void delete(FiwareScope scope, String id, Optional<String> type, Correlator correlator) throws NgsiError {
        Tenant tenant = tenant(scope.service());
        synchronized (tenant) {
            StoredEntity before = single(tenant.find(scope.servicePath(), id, type));
            tenant.remove(before);
            announce(tenant, EntityChange.delete(before), correlator);
        }
    }

    /** @throws NgsiError 404 or 409 */
    public StoredEntity get(String service, PathFilter paths, String id, Optional<String> type) throws NgsiError {
        return single(tenant(service).find(paths, id, type));
    }

    static StoredEntity single(List<StoredEntity> found) throws NgsiError {
        if (found.size() > 1) {
            throw NgsiError.ambiguous();
        }
        return found.stream().findFirst().orElseThrow(NgsiError::noEntity);
    }

    private Map<String, JsonNode> commandsIn(
            FiwareScope scope, EntityUpdate request, Action action, Map<String, AttributeInput> own) {
        Map<String, JsonNode> issued = new LinkedHashMap<>();
        if (action != Action.DELETE) {
            for (String name : commands.of(scope, request.id(), request.type())) {
                AttributeInput command = own.remove(name);
                if (command != null) {
                    issued.put(name, command.value());
                }
            }
        }
        return issued;
    }

    private EntityChange change(StoredEntity before, Map<String, AttributeInput> inputs, Action action, boolean forced)
            throws NgsiError {
        return switch (action) {
            case APPEND, UPDATE -> EntityChange.merge(before, inputs, forced, now());
            case REPLACE -> EntityChange.replace(before, inputs, now());
            case DELETE -> EntityChange.without(before, inputs.keySet(), now());
        };
    }

    private static Set<String> refused(StoredEntity before, Set<String> names, Action action) {
        Set<String> refused = new TreeSet<>(names);
        switch (action) {
            case UPDATE, DELETE -> refused.removeAll(before.attributes().keySet());
            case APPEND, REPLACE -> refused.clear();
        }
        return refused;
    }

    private void commit(Tenant tenant, EntityChange change, Correlator correlator) {
        tenant.put(change.after());
        announce(tenant, change, correlator);
    }

    private void announce(Tenant tenant, EntityChange change, Correlator correlator) {
        Instant now = now();
        for (Subscription subscription : tenant.subscriptions()) {
            if (subscription.triggeredBy(change, now)) {
                notifier.offer(new OutgoingNotification(subscription, change, correlator.next()));
            }
        }
    }
}
