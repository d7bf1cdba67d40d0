package io.furrow.model.result;

/** Names of entities on {@code data.collision}: encounters of two devices, predictions and crossings. */
public final class CollisionResult {
    public static final String TYPE = ResultTypes.PREFIX + "Collision";
    /** Type for a grid cell with too many devices to compare them all. */
    public static final String OVERFLOW_TYPE = ResultTypes.PREFIX + "CollisionOverflow";

    /** Id of the encounter, the same in all its records. */
    public static final String ENCOUNTER = "encounter";

    /** {@link #STARTED}, {@link #ONGOING}, {@link #ENDED}, {@code predicted} and so on. */
    public static final String PHASE = "phase";

    public static final String STARTED = "started";
    public static final String ONGOING = "ongoing";
    public static final String ENDED = "ended";

    /** Meters, at {@link #TIME}. */
    public static final String DISTANCE = "distance";
    /** Meters, the minimum so far. */
    public static final String MIN_DISTANCE = "minDistance";
    /** Epoch ms. */
    public static final String TIME = "time";
    /** Epoch ms. */
    public static final String START_TIME = "startTime";
    /** Seconds to the closest point of approach. */
    public static final String TCPA = "tcpa";
    /** Meters at the closest point of approach. */
    public static final String DCPA = "dcpa";

    /** Attributes of the device whose id is the lesser. */
    public static final Member FIRST = new Member("Device1");
    /** Attributes of the other device. */
    public static final Member SECOND = new Member("Device2");

    private CollisionResult() {}

    /** Names of the attributes of one device of the pair. */
    public static final class Member {
        private final String id;
        private final String type;
        private final String latitude;
        private final String longitude;
        private final String timestamp;
        private final String mission;
        private final String service;
        private final String servicePath;

        private Member(String prefix) {
            id = prefix + "_ID";
            type = prefix + "_type";
            latitude = prefix + "_latitude";
            longitude = prefix + "_longitude";
            timestamp = prefix + "_timestamp";
            mission = prefix + "_Mission";
            service = prefix + "_service";
            servicePath = prefix + "_servicePath";
        }

        public String id() {
            return id;
        }

        /** Returns the attribute with the type of the device's entity. */
        public String type() {
            return type;
        }

        /** Returns the attribute with the latitude in degrees. */
        public String latitude() {
            return latitude;
        }

        /** Returns the attribute with the longitude in degrees. */
        public String longitude() {
            return longitude;
        }

        /** Returns the attribute with the time of the position, epoch ms. */
        public String timestamp() {
            return timestamp;
        }

        /** Returns the attribute with the mission; its value is empty if the device is on none. */
        public String mission() {
            return mission;
        }

        /** Returns the attribute with the tenant, of {@link #SECOND} only, and only if its scope is not the record's. */
        public String service() {
            return service;
        }

        /** Returns the attribute with the service path, which is present if {@link #service()} is. */
        public String servicePath() {
            return servicePath;
        }
    }
}
