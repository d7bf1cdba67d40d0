package io.furrow.control.alarm;

import io.furrow.model.result.FieldResult;

/** Builds the ids of the entities that group alarms refer to: a mission, a domain or a field. */
public final class AlarmGroup {
    /** Group of devices without mission and domain. */
    static final String NONE = "without-mission";

    private static final String MISSION = "urn:ngsi-ld:Mission:";
    private static final String DOMAIN = "urn:ngsi-ld:Domain:";
    private static final String FIELD = FieldResult.TEMPERATURE_TYPE + ":";

    private AlarmGroup() {}

    /**
     * Returns the id of the mission's entity, or that of the domain's entity if there is no mission.
     *
     * @param mission empty if none
     * @param domain empty if none
     */
    public static String of(String mission, String domain) {
        if (!mission.isEmpty()) {
            return MISSION + mission;
        }
        return domain.isEmpty() ? NONE : DOMAIN + domain;
    }

    public static String ofField(String field) {
        return FIELD + field;
    }

    /** Human-readable name, for instance {@code mission weeding}. */
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
