package io.furrow.model.topic;

/** The topics that the parts of Furrow meet in. */
public final class Topics {
    /** Every change that was reported. */
    public static final String RAW = "data.raw";

    public static final String TEMPERATURE = "data.temperature";
    public static final String TEMPERATURE_LATE = "data.temperature.late";
    public static final String COLLISION = "data.collision";
    public static final String COLLISION_LATE = "data.collision.late";

    /** Where each stored image is. */
    public static final String IMAGES = "data.images";

    private Topics() {}

    /** All missions of a domain: {@code data.<domain>.realtime}. */
    public static String realtime(String domain) {
        return "data." + TopicName.of(domain) + ".realtime";
    }

    /** One mission: {@code data.<domain>.realtime.<mission>}. */
    public static String realtime(String domain, String mission) {
        return realtime(domain) + "." + TopicName.of(mission);
    }

    /** Where the unreadable records of a topic go. */
    public static String dead(String topic) {
        return topic + ".dead";
    }
}
