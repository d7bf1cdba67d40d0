package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;

/** Reads the times of entities that are not known yet from the context broker, many at a time. */
final class FirstSight {
    private static final Logger LOG = LoggerFactory.getLogger(FirstSight.class);

    private final BrokerClient client;
    private final ContextBrokerApi api;
    private final KnownTimes known;

    FirstSight(BrokerClient client, ContextBrokerApi api, KnownTimes known) {
        this.client = client;
        this.api = api;
        this.known = known;
    }

    /** Afterwards every entity of the changes is known, also those that do not exist. */
    void learn(Collection<Change> changes) throws BrokerAwayException, WrongSettingException {
        Map<FiwareScope, Map<String, Set<String>>> unknown = new LinkedHashMap<>();
        for (Change change : changes) {
            if (known.of(change.key()) == null) {
                Set<String> types = unknown.computeIfAbsent(change.key().scope(), scope -> new LinkedHashMap<>())
                        .computeIfAbsent(change.key().id(), id -> new LinkedHashSet<>());
                if (!change.isDeletion()) {
                    types.add(change.entity().type());
                }
            }
        }
        for (Map.Entry<FiwareScope, Map<String, Set<String>>> entry : unknown.entrySet()) {
            List<String> ids = new ArrayList<>(entry.getValue().keySet());
            for (int from = 0; from < ids.size(); from += api.idsPerRead()) {
                int to = Math.min(ids.size(), from + api.idsPerRead());
                read(entry.getKey(), entry.getValue(), ids.subList(from, to));
            }
        }
    }

    private void read(FiwareScope scope, Map<String, Set<String>> types, List<String> ids)
            throws BrokerAwayException, WrongSettingException {
        Map<String, Set<String>> asked = new LinkedHashMap<>();
        ids.forEach(id -> asked.put(id, types.get(id)));
        Outcome outcome = client.send(api.read(scope, asked));
        if (outcome instanceof Outcome.Done done) {
            found(scope, ids, done);
        } else if (outcome instanceof Outcome.Absent) {
            none(scope, ids);
        } else if (outcome instanceof Outcome.Refused refusal) {
            refused(scope, types, ids, refusal);
        } else if (outcome instanceof Outcome.Away away) {
            throw new BrokerAwayException(away);
        } else if (outcome instanceof Outcome.WrongSetting wrong) {
            throw new WrongSettingException(wrong.words());
        }
    }

    private void found(FiwareScope scope, List<String> ids, Outcome.Done done) throws WrongSettingException {
        try {
            Map<String, EntityTimes> times = api.times(ids, done);
            ids.forEach(id -> known.put(new EntityKey(scope, id), times.getOrDefault(id, new EntityTimes())));
        } catch (UnreadableException e) {
            throw new WrongSettingException("what should be a context broker answers a query with no entities: " + e);
        }
    }

    private void none(FiwareScope scope, List<String> ids) {
        ids.forEach(id -> known.put(new EntityKey(scope, id), new EntityTimes()));
    }

    /** One id that no entity can have makes the broker refuse all; the write of that one will be refused too. */
    private void refused(FiwareScope scope, Map<String, Set<String>> types, List<String> ids, Outcome.Refused refusal)
            throws BrokerAwayException, WrongSettingException {
        if (ids.size() == 1) {
            LOG.warn("The context broker does not say what it has of {}: {}", ids.get(0), refusal.words());
            none(scope, ids);
        } else {
            int half = ids.size() / 2;
            read(scope, types, ids.subList(0, half));
            read(scope, types, ids.subList(half, ids.size()));
        }
    }
}
