package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.Outcome;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.text.LogText;

/** Reads the times of entities that are not cached, or have expired, from the context broker, many per request. */
record EntityTimesLoader(BrokerClient client, ContextBrokerApi api, EntityTimesCache known) {
    private static final Logger LOG = LoggerFactory.getLogger(EntityTimesLoader.class);

    /** Afterwards every entity of the changes is cached, including those that do not exist. */
    void learn(Collection<EntityChange> changes) throws BrokerUnavailableException, WrongSettingException {
        Map<FiwareScope, Map<String, Set<String>>> unknown =
                types(changes.stream().filter(each -> !known.isFresh(each.key())));
        Map<EntityKey, EntityTimes> found = read(unknown);
        unknown.forEach((scope, ids) -> ids.keySet().forEach(id -> {
            EntityKey key = new EntityKey(scope, id);
            known.learn(key, found.getOrDefault(key, new EntityTimes()));
        }));
    }

    /** The entities that exist, and those that the context broker does not report on. */
    Map<EntityKey, EntityTimes> existing(Collection<EntityChange> deletions)
            throws BrokerUnavailableException, WrongSettingException {
        return read(types(deletions.stream()));
    }

    /** The types by scope and id, empty for all: the entity of a deletion may have another type. */
    private Map<FiwareScope, Map<String, Set<String>>> types(Stream<EntityChange> changes) {
        Map<FiwareScope, Map<String, Set<String>>> types = new LinkedHashMap<>();
        changes.forEach(each -> types.computeIfAbsent(each.key().scope(), scope -> new LinkedHashMap<>())
                .computeIfAbsent(each.key().id(), id -> new LinkedHashSet<>())
                .add(each.isDeletion() && api.isUnique(each.key()) ? "" : each.type()));
        return types;
    }

    /** Without absent entities. */
    private Map<EntityKey, EntityTimes> read(Map<FiwareScope, Map<String, Set<String>>> unknown)
            throws BrokerUnavailableException, WrongSettingException {
        Map<EntityKey, EntityTimes> found = new HashMap<>();
        for (Map.Entry<FiwareScope, Map<String, Set<String>>> entry : unknown.entrySet()) {
            List<String> ids = new ArrayList<>(entry.getValue().keySet());
            for (int from = 0; from < ids.size(); from += api.idsPerRead()) {
                int to = Math.min(ids.size(), from + api.idsPerRead());
                read(entry.getKey(), entry.getValue(), ids.subList(from, to), found);
            }
        }
        return found;
    }

    private void read(
            FiwareScope scope, Map<String, Set<String>> types, List<String> ids, Map<EntityKey, EntityTimes> found)
            throws BrokerUnavailableException, WrongSettingException {
        Map<String, Set<String>> asked = new LinkedHashMap<>();
        ids.forEach(id -> asked.put(id, types.get(id)));
        Outcome outcome = client.send(api.read(scope, asked));
        if (outcome instanceof Outcome.Done done) {
            found(scope, ids, done, found);
        } else if (outcome instanceof Outcome.Rejected refusal) {
            refused(scope, types, ids, refusal, found);
        } else if (outcome instanceof Outcome.Unavailable unavailable) {
            throw new BrokerUnavailableException(unavailable);
        } else if (outcome instanceof Outcome.WrongSetting wrong) {
            throw new WrongSettingException(wrong.words());
        } else if (outcome instanceof Outcome.Absent absent && absent.isResourceOfV2()) {
            throw new WrongSettingException(api.name() + " is not there: " + absent.words());
        }
    }

    private void found(FiwareScope scope, List<String> ids, Outcome.Done done, Map<EntityKey, EntityTimes> found)
            throws WrongSettingException {
        try {
            api.times(ids, done).forEach((id, times) -> found.put(new EntityKey(scope, id), times));
        } catch (UnreadableException e) {
            throw new WrongSettingException("what should be a context broker answers a query with no entities: "
                    + LogText.beginning(FailureText.of(e)));
        }
    }

    /**
     * One id that no entity can have makes the broker reject the whole query; the write of that entity will be rejected
     * too.
     */
    private void refused(
            FiwareScope scope,
            Map<String, Set<String>> types,
            List<String> ids,
            Outcome.Rejected refusal,
            Map<EntityKey, EntityTimes> found)
            throws BrokerUnavailableException, WrongSettingException {
        if (ids.size() == 1) {
            LOG.warn("the context broker rejects the query of {}: {}", ids.get(0), refusal.words());
            found.put(new EntityKey(scope, ids.get(0)), new EntityTimes());
        } else {
            int half = ids.size() / 2;
            read(scope, types, ids.subList(0, half), found);
            read(scope, types, ids.subList(half, ids.size()), found);
        }
    }
}
