package io.furrow.model.device;

import java.util.Collections;
import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The record of {@code service.secrets}, under {@link #KEY}: identifies the secret of a farm without revealing it.
 *
 * @param newest number of the key that derives passwords
 * @param apiKeys number of the key that derives API keys
 * @param byNumber fingerprint of each key
 */
public record SecretFingerprints(
        int newest,
        int apiKeys,
        @JsonProperty("fingerprints") Map<Integer, String> byNumber) implements StateRecord {
    /** Key of the topic's only record. */
    public static final String KEY = "farm";

    /** The relation of a process' secret to that of the farm. */
    public enum Relation {
        /** The same keys. */
        SAME,
        /** The farm's secret after further rotations. */
        NEWER,
        /** The farm's secret before its last rotation. */
        OLDER,
        /** Another secret. */
        ANOTHER
    }

    public SecretFingerprints {
        byNumber = Collections.unmodifiableMap(new TreeMap<>(byNumber));
    }

    public static SecretFingerprints of(FarmSecret secret) {
        Map<Integer, String> byNumber = new TreeMap<>();
        secret.keys().forEach(key -> byNumber.put(key.number(), key.fingerprint()));
        return new SecretFingerprints(secret.newestKey(), secret.apiKeys().number(), byNumber);
    }

    /** Returns the relation of these fingerprints of a process to those of the farm. */
    public Relation to(SecretFingerprints farm) {
        boolean shares = byNumber.keySet().stream().anyMatch(farm.byNumber::containsKey);
        boolean agrees = byNumber.entrySet().stream()
                .allMatch(each -> each.getValue().equals(farm.byNumber.getOrDefault(each.getKey(), each.getValue())));
        if (!shares || !agrees || newest == farm.newest && apiKeys != farm.apiKeys) {
            return Relation.ANOTHER;
        }
        if (newest == farm.newest) {
            return Relation.SAME;
        }
        return newest > farm.newest ? Relation.NEWER : Relation.OLDER;
    }

    /** Returns the fingerprint of the newest key. */
    public String fingerprint() {
        return byNumber.get(newest);
    }

    /** @throws UnreadableException if it is not such an object */
    public static SecretFingerprints read(byte[] value) throws UnreadableException {
        JsonNode json = NgsiJson.read(value);
        Map<Integer, String> byNumber = new TreeMap<>();
        for (Map.Entry<String, JsonNode> each : json.path("fingerprints").properties()) {
            if (each.getKey().matches("[1-9]\\d{0,8}") && each.getValue().isTextual()) {
                byNumber.put(Integer.valueOf(each.getKey()), each.getValue().textValue());
            }
        }
        int newest = json.path("newest").asInt();
        Reason.NOT_AN_EVENT.refuseIf(!byNumber.containsKey(newest), "it names no fingerprint of its newest key");
        return new SecretFingerprints(newest, json.path("apiKeys").asInt(), byNumber);
    }

    /** Returns the fingerprint and number of the newest key, as in {@link FarmSecret#toString()}. */
    @Override
    public String toString() {
        return fingerprint() + " (key " + newest + ")";
    }
}
