package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.annotation.JsonInclude;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.event.FiwareScope;

/**
 * The cause of an alarm.
 *
 * @param subject the affected entity or pair
 * @param identity unambiguous form of the subject: tenant, service path, types and subject, or the subject itself if
 *     that is unambiguous. There is at most one open alarm per kind and identity
 * @param text human-readable sentence
 * @param values numbers in the sentence, by name, from which a client can write it in another language
 * @param details what the sentence says of single devices, or of a fault
 * @param devices devices concerned, at most {@value #MAX_DEVICES}
 * @param validity period until the alarm expires unless the cause is repeated; null if it lasts until ended explicitly
 * @param group entity of the mission, domain or field, which limits the number of individual alarms; null if none
 * @param extent how many devices or pairs a group cause stands for; null for an individual cause
 */
public record Cause(
        AlarmKind kind,
        String subject,
        String identity,
        String text,
        Map<String, Double> values,
        List<Detail> details,
        List<AffectedDevice> devices,
        Duration validity,
        String group,
        Extent extent) {
    /** Maximum number of devices that an alarm names. */
    public static final int MAX_DEVICES = 20;

    /**
     * @param id of its entity
     * @param type of its entity; null if unknown
     * @param service its tenant; null for the default one
     * @param servicePath null for the root
     */
    public record AffectedDevice(String id, String type, String service, String servicePath) {
        /** @param type null if unknown */
        public static AffectedDevice of(String id, String type, FiwareScope scope) {
            FiwareScope usual = FiwareScope.DEFAULT;
            return new AffectedDevice(
                    id,
                    type,
                    scope.service().equals(usual.service()) ? null : scope.service(),
                    scope.servicePath().equals(usual.servicePath()) ? null : scope.servicePath());
        }
    }

    /**
     * A part of the sentence, from which a client can write it in another language.
     *
     * @param device id of the entity; null if it is about none
     * @param code kind of what is said
     * @param values names, numbers and times in it, by name; times are epoch ms
     */
    public record Detail(
            String device,
            String code,
            @JsonInclude(JsonInclude.Include.NON_EMPTY) Map<String, String> values) {}

    /**
     * Number of affected devices or pairs.
     *
     * @param total out of how many; null if unknown
     */
    public record Extent(int affected, Integer total) {}

    public Cause {
        devices = List.copyOf(devices.subList(0, Math.min(devices.size(), MAX_DEVICES)));
    }

    /** Creates an individual cause without a group. */
    public Cause(AlarmKind kind, String subject, String text, List<AffectedDevice> devices, Duration validity) {
        this(kind, subject, subject, text, Map.of(), List.of(), devices, validity, null, null);
    }

    /** @param value left out if it is not finite */
    public Cause withValue(String name, double value) {
        Map<String, Double> newValues = Double.isFinite(value) ? Map.of(name, value) : Map.of();
        return new Cause(kind, subject, identity, text, newValues, details, devices, validity, group, extent);
    }

    public Cause withDetails(List<Detail> newDetails) {
        return new Cause(kind, subject, identity, text, values, newDetails, devices, validity, group, extent);
    }

    public Cause inGroup(String newGroup) {
        return new Cause(kind, subject, identity, text, values, details, devices, validity, newGroup, extent);
    }

    /** @param newIdentity of {@link FiwareScope#identity(String, String)}, of the types and the subject */
    public Cause identifiedBy(String newIdentity) {
        return new Cause(kind, subject, newIdentity, text, values, details, devices, validity, group, extent);
    }

    /** Creates a group cause that lasts until it is ended explicitly. */
    public static Cause ofMany(AlarmKind kind, String group, String text, List<AffectedDevice> devices, Extent extent) {
        return new Cause(kind, group, group, text, Map.of(), List.of(), devices, null, group, extent);
    }

    static String key(AlarmKind kind, String identity) {
        return kind.code() + "|" + identity;
    }

    String key() {
        return key(kind, identity);
    }

    Long until(long now) {
        return validity == null ? null : Long.valueOf(now + validity.toMillis());
    }
}
