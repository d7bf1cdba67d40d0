package io.furrow.model.topic;

import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** The topics that connect the parts of Furrow. */
public final class Topics {
    /** All reported changes. */
    public static final String RAW = "data.raw";

    /** The newest value of every attribute of every entity; compacted. */
    public static final String LATEST = "data.latest";
    /** The context broker's native Kafka notifications. */
    public static final String NOTIFICATIONS = "ngsi.notifications";
    /** Requests to the manager of domains and its responses; the same for the other managers. */
    public static final String DOMAIN_MANAGER = "service.domainmanager";

    public static final String MISSION_MANAGER = "service.missionmanager";
    public static final String REPLAY_MANAGER = "service.replaymanager";
    public static final String ALARM_MANAGER = "service.alarmmanager";

    /** The desired domains, missions, templates and replays; compacted, written by the managers only. */
    public static final String DOMAINS = "service.domains";

    public static final String MISSIONS = "service.missions";
    public static final String TEMPLATES = "service.templates";
    public static final String REPLAYS = "service.replays";

    /** The device groups of missions, see {@code MissionDeviceList}; compacted. */
    public static final String MISSION_DEVICES = "service.missions.devices";

    /** The status of each mission; compacted. */
    public static final String MISSIONS_STATUS = "service.missions.status";
    /** Status of each device, reported by its host; compacted. */
    public static final String DEVICES_STATUS = "service.devices.status";
    /** The last report of each device, its battery and whether it is silent; compacted. */
    public static final String DEVICES_HEALTH = "service.devices.health";

    public static final String DEVICES_CONNECTION = "service.devices.connection";
    /** Faults of Furrow's parts, repeated while they last; compacted. */
    public static final String FAULTS = "service.faults";

    /** Status of each replay, reported by its player; compacted. */
    public static final String REPLAYS_STATUS = "service.replays.status";

    /** The missions that are stored and can be played back, see {@code RecordedMission}; compacted. */
    public static final String RECORDINGS = "service.recordings";

    /** The domain and mission of each device, see {@code DeviceVersion}; compacted. */
    public static final String DEVICES = "service.devices";
    /** The fields of the farm, version by version, see {@code FieldVersion}; compacted. */
    public static final String FIELDS = "service.fields";

    /** Open and recently closed alarms and who acknowledged them; compacted. */
    public static final String ALARMS = "service.alarms";
    /** The state of each alarm that the webhook has received; compacted. */
    public static final String ALARMS_DELIVERED = "service.alarms.delivered";
    /** The fingerprints of the farm's secret, see {@code SecretFingerprints}; compacted. */
    public static final String SECRETS = "service.secrets";
    /** Audit of all commands with user, time and result. */
    public static final String AUDIT = "service.audit";

    /** Desired entities of the context broker: domains, missions. */
    public static final String CONTEXT = "data.context";

    public static final String TEMPERATURE = "data.temperature";
    public static final String TEMPERATURE_LATE = "data.temperature.late";
    public static final String COLLISION = "data.collision";
    public static final String COLLISION_LATE = "data.collision.late";
    /** Grid cells with too many close pairs to follow them all. */
    public static final String COLLISION_OVERFLOW = "data.collision.overflow";

    public static final String COVERAGE = "data.coverage";
    public static final String COVERAGE_LATE = "data.coverage.late";
    /** Cells of fields that are covered. */
    public static final String COVERAGE_LAYER = "data.coverage.layer";

    public static final String PRESENCE = "data.presence";
    public static final String PRESENCE_LATE = "data.presence.late";

    /** Results about the clocks of devices. */
    public static final String CLOCKS = "data.clocks";

    /** The locations of stored images. */
    public static final String IMAGES = "data.images";

    /** The catalog: types, attributes, missions, sizes. */
    public static final String CATALOG = "data.catalog";

    private static final String DEAD = ".dead";

    private static final String DATA = "data";
    /** Topics of replays: {@code data.<mission>.replay.<first eight digits of an id>}. */
    private static final Pattern REPLAY = Pattern.compile("data\\.([^.]+)\\.replay\\.([0-9a-f]{8})");

    private Topics() {}

    /** Returns the topic of all missions of a domain: {@code data.<domain>.realtime}. */
    public static String realtime(String domain) {
        return "data." + TopicName.of(domain) + ".realtime";
    }

    /** Returns the topic of a mission: {@code data.<domain>.realtime.<mission>}. */
    public static String realtime(String domain, String mission) {
        return realtime(domain) + "." + TopicName.of(mission);
    }

    /** Returns the topic of a replay: {@code data.<mission>.replay.<id8>}. */
    public static String replay(String mission, String id8) {
        return "data." + TopicName.of(mission) + ".replay." + id8;
    }

    /** Returns whether the topic is that of a replay. */
    public static boolean isReplay(String topic) {
        return topic.contains(".replay.") && REPLAY.matcher(topic).matches();
    }

    /** Returns whether the topic is that of a replay or of its results. */
    public static boolean isOfReplay(String topic) {
        return topic.contains(".replay.") && REPLAY.matcher(topic).lookingAt();
    }

    /** Returns the replay of a topic, {@code <mission>.<id8>}; empty for other topics. */
    public static Optional<String> replayOf(String topic) {
        Matcher replay = REPLAY.matcher(topic);
        return replay.matches() ? Optional.of(replay.group(1) + "." + replay.group(2)) : Optional.empty();
    }

    /**
     * Returns the topic of a result: the output, or for a replay a topic of its own, for instance {@code
     * data.collision.late} of {@code data.hoeing.replay.0a1b2c3d} becomes {@code
     * data.hoeing.replay.0a1b2c3d.collision.late}.
     *
     * @param input the topic in which the result was found
     * @param output the topic of the result for other inputs
     */
    public static String resultOf(String input, String output) {
        if (!isReplay(input)) {
            return output;
        }
        return output.startsWith(DATA + ".") ? input + output.substring(DATA.length()) : input + "." + output;
    }

    /** Returns the topic of the dead letters of a topic. */
    public static String dead(String topic) {
        return topic + DEAD;
    }

    /** Returns the topic to which a topic of dead letters belongs; empty for other topics. */
    public static Optional<String> ofDeadLetters(String topic) {
        return topic.endsWith(DEAD) && topic.length() > DEAD.length()
                ? Optional.of(topic.substring(0, topic.length() - DEAD.length()))
                : Optional.empty();
    }
}
