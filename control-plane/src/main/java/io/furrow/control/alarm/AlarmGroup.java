package io.furrow.control.alarm;

/** Names the entities that alarms of many devices are about: a mission, a domain, a field. */
public final class AlarmGroup {
    /** Of devices that are on no mission and in no domain. */
    static final String NONE = "without-mission";

    private static final String MISSION = "urn:ngsi-ld:Mission:";
    private static final String DOMAIN = "urn:ngsi-ld:Domain:";
    private static final String FIELD = "Analytics:FieldTemperature:";

    private AlarmGroup() {}

    /**
     * The mission's entity, else that of the domain.
     *
     * @param mission empty for none
     * @param domain empty for none
     */
    public static String of(String mission, String domain) {
        if (!mission.isEmpty()) {
            return MISSION + mission;
        }
        return domain.isEmpty() ? NONE : DOMAIN + domain;
    }

    static String ofField(String field) {
        return FIELD + field;
    }

    /** For people, for instance {@code mission weeding}. */
    public static String label(String group) {
        if (group.startsWith(MISSION)) {
            return "mission " + group.substring(MISSION.length());
        } else if (group.startsWith(DOMAIN)) {
            return "domain " + group.substring(DOMAIN.length()) + " outside of missions";
        } else if (group.startsWith(FIELD)) {
            return "field " + group.substring(FIELD.length());
        }
        return "no mission and no domain";
    }
}
