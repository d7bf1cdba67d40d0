package io.furrow.model.topic;

import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** The topics that the parts of Furrow meet in. */
public final class Topics {
    /** Every change that was reported. */
    public static final String RAW = "data.raw";

    /** The newest value of every attribute of every entity; compacted. */
    public static final String LATEST = "data.latest";
    /** The context broker's native Kafka notifications. */
    public static final String NOTIFICATIONS = "ngsi.notifications";
    /** Requests to the manager of domains, and its responses; so for missions and replays. */
    public static final String DOMAIN_MANAGER = "service.domainmanager";

    public static final String MISSION_MANAGER = "service.missionmanager";
    public static final String REPLAY_MANAGER = "service.replaymanager";
    public static final String ALARM_MANAGER = "service.alarmmanager";

    /** What domains, missions, templates and replays there shall be; compacted, written by the managers only. */
    public static final String DOMAINS = "service.domains";

    public static final String MISSIONS = "service.missions";
    public static final String TEMPLATES = "service.templates";
    public static final String REPLAYS = "service.replays";

    /** The device groups of missions, see {@code MissionDeviceList}; compacted. */
    public static final String MISSION_DEVICES = "service.missions.devices";

    /** How far each mission is; compacted. */
    public static final String MISSIONS_STATUS = "service.missions.status";
    /** Status of each device, reported by its host; compacted. */
    public static final String DEVICES_STATUS = "service.devices.status";
    /** When each device was last heard of, its battery, whether it is silent; compacted. */
    public static final String DEVICES_HEALTH = "service.devices.health";

    public static final String DEVICES_CONNECTION = "service.devices.connection";
    /** What does not work in Furrow itself, by its part, repeated while it lasts; compacted. */
    public static final String FAULTS = "service.faults";

    /** Status of each replay, reported by its player; compacted. */
    public static final String REPLAYS_STATUS = "service.replays.status";

    /** The missions that are stored and can be played back, see {@code RecordedMission}; compacted. */
    public static final String RECORDINGS = "service.recordings";

    /** To whom each device belongs, see {@code DeviceVersion}; compacted. */
    public static final String DEVICES = "service.devices";
    /** The fields of the farm, version by version, see {@code FieldVersion}; compacted. */
    public static final String FIELDS = "service.fields";

    /** What somebody ought to look at, and whether somebody did; compacted. */
    public static final String ALARMS = "service.alarms";
    /** What of each alarm the webhook knows; compacted. */
    public static final String ALARMS_DELIVERED = "service.alarms.delivered";
    /** The fingerprints of the farm's secret, see {@code SecretFingerprints}; compacted. */
    public static final String SECRETS = "service.secrets";
    /** Every command: who, what, when, with which result. */
    public static final String AUDIT = "service.audit";

    /** Entities that shall exist in the context broker: domains, missions. */
    public static final String CONTEXT = "data.context";

    public static final String TEMPERATURE = "data.temperature";
    public static final String TEMPERATURE_LATE = "data.temperature.late";
    public static final String COLLISION = "data.collision";
    public static final String COLLISION_LATE = "data.collision.late";
    /** Where so many pairs were close that not all are followed. */
    public static final String COLLISION_OVERFLOW = "data.collision.overflow";

    public static final String PRESENCE = "data.presence";
    public static final String PRESENCE_LATE = "data.presence.late";

    /** What jobs say of the clocks of devices. */
    public static final String CLOCKS = "data.clocks";

    /** Where each stored image is. */
    public static final String IMAGES = "data.images";

    /** What there is: types, attributes, missions, sizes. */
    public static final String CATALOG = "data.catalog";

    private static final String DEAD = ".dead";

    private static final String DATA = "data";
    /** What is played back: {@code data.<mission>.replay.<first eight digits of an id>}. */
    private static final Pattern REPLAY = Pattern.compile("data\\.([^.]+)\\.replay\\.([0-9a-f]{8})");

    private Topics() {}

    /** All missions of a domain: {@code data.<domain>.realtime}. */
    public static String realtime(String domain) {
        return "data." + TopicName.of(domain) + ".realtime";
    }

    /** One mission: {@code data.<domain>.realtime.<mission>}. */
    public static String realtime(String domain, String mission) {
        return realtime(domain) + "." + TopicName.of(mission);
    }

    /** One replay: {@code data.<mission>.replay.<id8>}. */
    public static String replay(String mission, String id8) {
        return "data." + TopicName.of(mission) + ".replay." + id8;
    }

    /** Whether the topic is that of a replay. */
    public static boolean isReplay(String topic) {
        return topic.contains(".replay.") && REPLAY.matcher(topic).matches();
    }

    /** Whether the topic is that of a replay, or of what was found in one. */
    public static boolean isOfReplay(String topic) {
        return topic.contains(".replay.") && REPLAY.matcher(topic).lookingAt();
    }

    /** The replay whose topic it is, {@code <mission>.<id8>}; empty of any other topic. */
    public static Optional<String> replayOf(String topic) {
        Matcher replay = REPLAY.matcher(topic);
        return replay.matches() ? Optional.of(replay.group(1) + "." + replay.group(2)) : Optional.empty();
    }

    /**
     * Where a result goes: to the output, but what is found in a replay to a topic of that replay's own, for instance
     * {@code data.collision.late} of {@code data.hoeing.replay.0a1b2c3d} to {@code data.hoeing.replay.0a1b2c3d.collision.late}.
     *
     * @param input the topic that the result was found in
     * @param output where the same result goes for other topics
     */
    public static String resultOf(String input, String output) {
        if (!isReplay(input)) {
            return output;
        }
        return output.startsWith(DATA + ".") ? input + output.substring(DATA.length()) : input + "." + output;
    }

    /** Where the unreadable records of a topic go. */
    public static String dead(String topic) {
        return topic + DEAD;
    }

    /** The topic whose dead letters a topic takes; empty if it takes none. */
    public static Optional<String> ofDeadLetters(String topic) {
        return topic.endsWith(DEAD) && topic.length() > DEAD.length()
                ? Optional.of(topic.substring(0, topic.length() - DEAD.length()))
                : Optional.empty();
    }
}
