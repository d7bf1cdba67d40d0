package io.furrow.ingest.route;

import java.io.IOException;
import java.io.Serializable;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.TimeUnit;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.flink.kafka.TopicNames;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.TopicName;
import io.furrow.model.topic.Topics;

/**
 * Admits domains and missions that events name: those of {@code service.domains} and {@code service.missions}, those that have a
 * topic, and others while the number of their topics is below the limit. As many further names without a topic are admitted between
 * restarts. An admitted name creates topics and a collection, which stay.
 *
 * <p>Has no state in Flink: the existing topics show which names were admitted.
 */
public final class NameBudget implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final Logger LOG = LoggerFactory.getLogger(NameBudget.class);
    /** A topic of a domain, or of a mission. */
    private static final Pattern ROUTE = Pattern.compile("data\\.[^.]+\\.realtime(?:\\.(.+))?");
    /** Minimum time between listings of topics to find unknown names. */
    private static final long READ_EVERY = Duration.ofSeconds(1).toMillis();

    private static final int READ_SHARE = 10;

    private static final Managed OF_ANY_DOMAIN = new Managed("", Long.MAX_VALUE);

    private final TopicSnapshot domainsTopic;
    private final TopicSnapshot missionsTopic;
    private final TopicNames topics;
    private final boolean makesTopics;
    private final int limit;
    private transient Map<String, Managed> domains;
    private transient Map<String, Managed> missions;
    /** Topics of domains and missions. */
    private transient Set<String> there;
    /** The number of these whose names the control plane neither manages nor deleted, which would end their topics. */
    private transient long others;
    /** Topics about to be created. */
    private transient Set<String> admitted;

    private transient Set<Name> withoutTopic;

    private transient long nextReading;

    /**
     * @param domains the content of {@code service.domains}
     * @param missions the content of {@code service.missions}
     * @param topics existing topics
     * @param makesTopics whether a name gets a topic
     * @param limit topics of other names
     */
    public NameBudget(
            TopicSnapshot domains, TopicSnapshot missions, TopicNames topics, boolean makesTopics, int limit) {
        this.domainsTopic = domains;
        this.missionsTopic = missions;
        this.topics = topics;
        this.makesTopics = makesTopics;
        this.limit = limit;
    }

    /** @param mission empty for the domain itself */
    private record Name(String domain, String mission) {
        String topic() {
            return mission.isEmpty() ? Topics.realtime(domain) : Topics.realtime(domain, mission);
        }
    }

    /** A mission of the control plane, or a domain, which has no domain itself. */
    private record Managed(String domain, long created) {}

    /** Reads all names before the first event. */
    void open() throws IOException {
        admitted = new HashSet<>();
        withoutTopic = new HashSet<>();
        read();
    }

    /** @throws UnreadableException if it is a new name, beyond the budget */
    void checkDomain(String domain, long now) throws UnreadableException {
        if (!domains.containsKey(domain)) {
            admit(new Name(domain, ""), now);
        }
    }

    /**
     * Checks the mission that an event names.
     *
     * @param domain of the event; may be empty
     * @param inUse whether the entity reported it before, or belongs to it as a device
     * @throws UnreadableException if it is a mission of another domain, or a new name beyond the budget
     */
    void checkMission(String domain, String mission, boolean inUse, long time, long now) throws UnreadableException {
        if (isOfAnother(domain, mission, time) && (!isDue(now) || stillIsAfterReading(domain, mission, time, now))) {
            throw new UnreadableException(
                    Reason.UNKNOWN_MISSION,
                    "mission " + mission + " belongs to domain "
                            + missions.get(mission).domain() + ", the event to domain " + domain);
        }
        if (!inUse && !isManaged(new Name(domain, mission))) {
            admit(new Name(domain, mission), now);
        }
    }

    /** An event from before the mission's creation may belong to an earlier one of this name. */
    private boolean isOfAnother(String domain, String mission, long time) {
        Managed known = missions.getOrDefault(mission, OF_ANY_DOMAIN);
        return time >= known.created() && !known.domain().equals(domain) && domains.containsKey(domain);
    }

    private boolean stillIsAfterReading(String domain, String mission, long time, long now) {
        readAgain(now);
        return isOfAnother(domain, mission, time);
    }

    private boolean isManaged(Name name) {
        if (name.mission().isEmpty()) {
            return domains.containsKey(name.domain());
        }
        Managed known = missions.get(name.mission());
        return known != null
                && (name.domain().isEmpty()
                        || known.domain().isEmpty()
                        || known.domain().equals(name.domain()));
    }

    private void admit(Name name, long now) throws UnreadableException {
        if (isThere(name)) {
            return;
        }
        if (isDue(now)) {
            readAgain(now);
        }
        if (isManaged(name) || isThere(name)) {
            return;
        }
        boolean getsTopic = makesTopics && !name.domain().isEmpty();
        long used = getsTopic ? others + admitted.size() : withoutTopic.size();
        if (used >= limit) {
            throw new UnreadableException(
                    Reason.UNKNOWN_MISSION,
                    "%s is not known, and %d names that are not known %s"
                            .formatted(
                                    name.mission().isEmpty() ? "domain " + name.domain() : "mission " + name.mission(),
                                    used,
                                    getsTopic
                                            ? "have topics; delete topics that are of no more use, or see --other-names"
                                            : "and have no topic were taken since the start; see --other-names"));
        }
        if (getsTopic) {
            admitted.add(name.topic());
        } else {
            withoutTopic.add(name);
        }
    }

    private boolean isThere(Name name) {
        return there.contains(name.topic()) || admitted.contains(name.topic()) || withoutTopic.contains(name);
    }

    private boolean isDue(long now) {
        return now >= nextReading;
    }

    /** A slow read is repeated less often, and after a failed one the previous result stays valid. */
    private void readAgain(long now) {
        long began = System.nanoTime();
        try {
            read();
        } catch (IOException e) {
            LOG.warn("missions and domains could not be read again", e);
        }
        long took = TimeUnit.NANOSECONDS.toMillis(System.nanoTime() - began);
        nextReading = now + took + Math.max(READ_EVERY, READ_SHARE * took);
    }

    private void read() throws IOException {
        Set<String> deletedDomains = new HashSet<>();
        Set<String> deletedMissions = new HashSet<>();
        domains = read(domainsTopic, deletedDomains);
        missions = read(missionsTopic, deletedMissions);
        there = topics.read().stream()
                .filter(topic -> ROUTE.matcher(topic).matches()
                        && Topics.ofDeadLetters(topic).isEmpty())
                .collect(Collectors.toSet());
        admitted.removeAll(there);

        Set<String> known = new HashSet<>();
        Stream.concat(domains.keySet().stream(), deletedDomains.stream())
                .forEach(domain -> known.add(Topics.realtime(domain)));
        missions.forEach((mission, managed) -> known.add(Topics.realtime(managed.domain(), mission)));
        Set<String> deleted = deletedMissions.stream().map(TopicName::of).collect(Collectors.toSet());
        others = there.stream()
                .filter(topic -> !known.contains(topic) && !deleted.contains(missionIn(topic)))
                .count();
    }

    /** The mission in the topic's name; empty in that of a domain. */
    private static String missionIn(String topic) {
        Matcher route = ROUTE.matcher(topic);
        return route.matches() && route.group(1) != null ? route.group(1) : "";
    }

    private static Map<String, Managed> read(TopicSnapshot topic, Set<String> deleted) throws IOException {
        Map<String, Managed> managed = new HashMap<>();
        for (TopicRecord record : topic.read()) {
            String name = record.key() == null ? null : new String(record.key(), StandardCharsets.UTF_8);
            if (name != null && record.value() == null) {
                managed.remove(name);
                deleted.add(name);
            } else if (name != null) {
                managed.put(name, managed(record));
                deleted.remove(name);
            }
        }
        return managed;
    }

    /** An unreadable record counts as existing, in any domain. */
    private static Managed managed(TopicRecord record) {
        try {
            JsonNode json = NgsiJson.read(record.value());
            return new Managed(
                    json.path("domain").asText(), json.path("created").asLong());
        } catch (UnreadableException e) {
            return OF_ANY_DOMAIN;
        }
    }
}
