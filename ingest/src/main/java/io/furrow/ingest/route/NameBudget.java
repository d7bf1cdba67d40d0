package io.furrow.ingest.route;

import java.io.IOException;
import java.io.Serializable;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Admits the domains and missions that events name: those of {@code service.domains} and {@code service.missions} always, so
 * many others in an hour of processing time. An admitted name makes topics and a collection, which nobody removes.
 *
 * <p>Not a part of the state: names that entities had before a restart are in use, see {@link AssignMission}. Admitted names are
 * forgotten when they were not used for a day.
 */
public final class NameBudget implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final long HOUR = Duration.ofHours(1).toMillis();
    private static final long FORGOTTEN_AFTER = Duration.ofDays(1).toMillis();
    /** A name that nobody knows is looked for on the topics at most this often. */
    private static final long READ_EVERY = Duration.ofSeconds(1).toMillis();

    private static final Managed OF_ANY_DOMAIN = new Managed("", Long.MAX_VALUE);

    private final TopicSnapshot domainsTopic;
    private final TopicSnapshot missionsTopic;
    private final int perHour;
    private transient Map<String, Managed> domains;
    private transient Map<String, Managed> missions;
    private transient Map<Name, Long> admitted;
    private transient long readAt;
    private transient long hour;
    private transient int left;

    /**
     * @param domains what is on {@code service.domains}
     * @param missions what is on {@code service.missions}
     * @param perHour other names that are admitted per hour
     */
    public NameBudget(TopicSnapshot domains, TopicSnapshot missions, int perHour) {
        this.domainsTopic = domains;
        this.missionsTopic = missions;
        this.perHour = perHour;
    }

    /** @param mission empty for the domain itself */
    private record Name(String domain, String mission) {}

    /** A mission of the control plane, or a domain, which has no domain itself. */
    private record Managed(String domain, long created) {}

    /** Reads what is known before the first event comes. */
    void open() throws IOException {
        admitted = new HashMap<>();
        left = perHour;
        read(0);
    }

    /** @throws UnreadableException if it is a new name, beyond the budget */
    void checkDomain(String domain, long now) throws IOException, UnreadableException {
        if (!domains.containsKey(domain)) {
            admit(new Name(domain, ""), now);
        }
    }

    /**
     * Checks the mission that an event names.
     *
     * @param domain of the event; may be empty
     * @param inUse whether the entity reported for it before
     * @throws UnreadableException if it is a mission of another domain, or a new name beyond the budget
     */
    void checkMission(String domain, String mission, boolean inUse, long time, long now)
            throws IOException, UnreadableException {
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

    /** An event of before the mission was created may be of an earlier one of this name. */
    private boolean isOfAnother(String domain, String mission, long time) {
        Managed known = missions.getOrDefault(mission, OF_ANY_DOMAIN);
        return time >= known.created() && !known.domain().equals(domain) && domains.containsKey(domain);
    }

    private boolean stillIsAfterReading(String domain, String mission, long time, long now) throws IOException {
        read(now);
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

    private void admit(Name name, long now) throws IOException, UnreadableException {
        if (admitted.computeIfPresent(name, (same, used) -> now) != null) {
            return;
        }
        if (isDue(now)) {
            read(now);
        }
        if (isManaged(name)) {
            return;
        }
        if (now - hour >= HOUR) {
            hour = now;
            left = perHour;
            admitted.values().removeIf(used -> now - used >= FORGOTTEN_AFTER);
        }
        if (left == 0) {
            throw new UnreadableException(
                    Reason.UNKNOWN_MISSION,
                    "%s is not known, and %d new names were taken within the hour; see --new-names"
                            .formatted(
                                    name.mission().isEmpty() ? "domain " + name.domain() : "mission " + name.mission(),
                                    perHour));
        }
        left--;
        admitted.put(name, now);
    }

    private boolean isDue(long now) {
        return now - readAt >= READ_EVERY;
    }

    private void read(long now) throws IOException {
        domains = read(domainsTopic);
        missions = read(missionsTopic);
        readAt = now;
    }

    private static Map<String, Managed> read(TopicSnapshot topic) throws IOException {
        Map<String, Managed> managed = new HashMap<>();
        for (TopicRecord record : topic.read()) {
            if (record.key() != null) {
                managed.compute(new String(record.key(), StandardCharsets.UTF_8), (name, before) -> managed(record));
            }
        }
        return managed;
    }

    /** Null where it was deleted. What cannot be read is there all the same, of any domain. */
    private static Managed managed(TopicRecord record) {
        if (record.value() == null) {
            return null;
        }
        try {
            JsonNode json = NgsiJson.read(record.value());
            return new Managed(
                    json.path("domain").asText(), json.path("created").asLong());
        } catch (UnreadableException e) {
            return OF_ANY_DOMAIN;
        }
    }
}
