package io.furrow.model.device;

import java.util.Objects;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The domain and mission of a device from a time on: a record of {@code service.devices}, key = {@link #key()}, value =
 * {@link #toBytes()}. A record without a value ends the device at its record timestamp.
 *
 * @param id id of the entity as which the device reports
 * @param service tenant, empty for the default one
 * @param servicePath {@code /} for the root
 * @param domain empty for none
 * @param mission empty for none
 * @param from event time from which this version is valid, epoch ms
 * @param until event time at which it ends, epoch ms; null if it is valid until the next version
 * @param sequence grows with every version of a device; a version with a smaller one is obsolete
 * @param carriedBy id of the entity that carries this one; null if none does
 * @param stationary whether it never moves: two such devices never collide
 */
public record DeviceVersion(
        String id,
        String service,
        String servicePath,
        String domain,
        String mission,
        long from,
        Long until,
        long sequence,
        String carriedBy,
        @JsonInclude(JsonInclude.Include.NON_DEFAULT) boolean stationary)
        implements StateRecord {
    public DeviceVersion {
        Objects.requireNonNull(id);
        Objects.requireNonNull(domain);
        Objects.requireNonNull(mission);
    }

    /** Creates a version of a device that may move. */
    public DeviceVersion(
            String id,
            String service,
            String servicePath,
            String domain,
            String mission,
            long from,
            Long until,
            long sequence,
            String carriedBy) {
        this(id, service, servicePath, domain, mission, from, until, sequence, carriedBy, false);
    }

    /**
     * Reads the value of a record. {@code service}, {@code servicePath}, {@code domain}, {@code mission}, {@code
     * until}, {@code carriedBy} and {@code stationary} may be missing or null; unknown members are ignored.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} if it is not such an
     * object
     */
    public static DeviceVersion read(byte[] value) throws UnreadableException {
        JsonNode json = NgsiJson.read(value);
        Reason.NOT_AN_EVENT.refuseIf(text(json, "id").isBlank(), "the device has no member 'id' with a text");
        FiwareScope scope = FiwareScope.of(text(json, "service"), text(json, "servicePath"));
        long from = number(json, "from");
        Long until = json.hasNonNull("until") ? Long.valueOf(number(json, "until")) : null;
        Reason.NOT_AN_EVENT.refuseIf(until != null && until < from, "'until' is before 'from'");
        return new DeviceVersion(
                text(json, "id"),
                scope.service(),
                scope.servicePath(),
                text(json, "domain"),
                text(json, "mission"),
                from,
                until,
                number(json, "sequence"),
                json.hasNonNull("carriedBy") ? text(json, "carriedBy") : null,
                json.path("stationary").asBoolean());
    }

    /** Returns the record's key: tenant, service path and id, because two tenants may have devices with the same id. */
    public String key() {
        return new FiwareScope(service, servicePath).identity(id);
    }

    /** Returns whether it is valid at an event time in epoch ms, regardless of later versions. */
    public boolean holdsAt(long time) {
        return from <= time && (until == null || time < until);
    }

    /** Returns the version ended at a time. */
    public DeviceVersion endingAt(long time) {
        return new DeviceVersion(
                id, service, servicePath, domain, mission, from, time, sequence, carriedBy, stationary);
    }

    /** Returns the version with another sequence. */
    public DeviceVersion numbered(long other) {
        return new DeviceVersion(id, service, servicePath, domain, mission, from, until, other, carriedBy, stationary);
    }

    private static String text(JsonNode json, String member) throws UnreadableException {
        JsonNode value = json.path(member);
        if (value.isMissingNode() || value.isNull()) {
            return "";
        }
        if (!value.isTextual()) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "'" + member + "' of the device is not text");
        }
        return value.textValue();
    }

    private static long number(JsonNode json, String member) throws UnreadableException {
        JsonNode value = json.path(member);
        if (!value.isIntegralNumber() || !value.canConvertToLong() || value.longValue() < 0) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT, "'" + member + "' of the device is not a whole number from 0 on");
        }
        return value.longValue();
    }
}
