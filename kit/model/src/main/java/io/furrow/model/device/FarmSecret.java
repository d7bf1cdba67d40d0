package io.furrow.model.device;

import java.io.IOException;
import java.net.URLDecoder;
import java.net.URLEncoder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.security.SecureRandom;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Base64;
import java.util.Comparator;
import java.util.List;
import java.util.Objects;
import java.util.Optional;

/**
 * The secret of a farm, from which the API key of each mission and the MQTT password of each device are derived: the
 * control plane, which provisions devices, and their host derive the same ones without sending passwords through
 * topics. The secret grants access to all of them.
 *
 * <p>After a rotation the secret has several keys. The newest derives passwords; those of older keys are accepted until
 * their expiry. API keys are parts of MQTT topics, so one key continues to derive them through rotations.
 */
public final class FarmSecret {
    /** Prefix of all its MQTT users. */
    public static final String USER_PREFIX = "furrow.";

    private static final int GENERATED_BYTES = 32;

    private final List<FarmKey> keys;
    private final FarmKey apiKeys;
    private final List<FarmKey> accepted;

    /** User and password at the MQTT broker; {@link #toString()} omits the password. */
    public record Login(String user, String password) {
        @Override
        public String toString() {
            return user;
        }
    }

    /**
     * Creates a secret with one key.
     *
     * @throws IllegalArgumentException if there are fewer than 16 bytes
     */
    public FarmSecret(byte[] secret) {
        this(new FarmKey(1, new String(secret, StandardCharsets.UTF_8), null));
    }

    private FarmSecret(FarmKey only) {
        this(List.of(only), only);
    }

    /** @param apiKeys the key that derives API keys */
    FarmSecret(List<FarmKey> keys, FarmKey apiKeys) {
        this(keys, apiKeys, keys);
    }

    private FarmSecret(List<FarmKey> keys, FarmKey apiKeys, List<FarmKey> accepted) {
        this.keys = keys.stream()
                .sorted(Comparator.comparingInt(FarmKey::number).reversed())
                .toList();
        this.apiKeys = apiKeys;
        this.accepted = this.keys.stream().filter(accepted::contains).toList();
    }

    /** Generates a secret with one key of 256 random bits. */
    public static FarmSecret generate() {
        return new FarmSecret(random(1));
    }

    private static FarmKey random(int number) {
        byte[] bytes = new byte[GENERATED_BYTES];
        new SecureRandom().nextBytes(bytes);
        return new FarmKey(number, Base64.getEncoder().encodeToString(bytes), null);
    }

    /**
     * Reads a file, see {@link FarmSecretCodec}.
     *
     * @throws IOException if it cannot be read or is not a secret; the message says which file, why and what to do
     */
    public static FarmSecret read(Path file) throws IOException {
        return FarmSecretCodec.read(file);
    }

    /**
     * Returns the secret with a new key that derives passwords.
     *
     * @param now keys that expired before are dropped, except the one that derives API keys
     * @param until expiry of the passwords of the previous key
     * @param newApiKeys whether the new key derives API keys, too; older keys then only recognize theirs
     */
    public FarmSecret rotated(Instant now, Instant until, boolean newApiKeys) {
        FarmKey newKey = random(newest().number() + 1);
        List<FarmKey> next = new ArrayList<>(List.of(newKey));
        for (FarmKey key : keys) {
            // The previous key always stays: it proves to the farm that this secret succeeds its own.
            if (key.until() == null) {
                next.add(key.endingAt(until));
            } else if (key.isAcceptedAt(now) || key.equals(apiKeys)) {
                next.add(key);
            }
        }
        int apiKeyNumber = newApiKeys ? newKey.number() : apiKeys.number();
        return new FarmSecret(
                next,
                next.stream()
                        .filter(key -> key.number() == apiKeyNumber)
                        .findFirst()
                        .orElseThrow());
    }

    /** Returns the secret at a time: only keys that are accepted then derive logins. */
    public FarmSecret at(Instant time) {
        List<FarmKey> validKeys =
                keys.stream().filter(key -> key.isAcceptedAt(time)).toList();
        return validKeys.equals(accepted) ? this : new FarmSecret(keys, apiKeys, validKeys);
    }

    /**
     * Returns the first part of a mission's MQTT topics, {@code /<apikey>/<device>/attrs}: 22 of {@code A-Za-z0-9_-}.
     */
    public String apiKey(String mission) {
        return apiKey(apiKeys, mission);
    }

    /** Returns whether any key of this secret derived the API key for the mission. */
    public boolean madeApiKey(String apiKey, String mission) {
        return keys.stream().anyMatch(key -> apiKey(key, mission).equals(apiKey));
    }

    private static String apiKey(FarmKey key, String mission) {
        return key.code("apikey", mission, "");
    }

    /** Returns the login of a device whose credentials were never rotated. */
    public Login device(String mission, String device) {
        return device(mission, device, 0);
    }

    /**
     * Returns the login of a device, derived by the newest key: user {@code
     * furrow.d.<mission>.<device>.<key>.<generation>}, with mission and device percent-encoded except {@code
     * A-Za-z0-9_-}, so that no two logins share a user.
     *
     * @param device its id at the IoT Agent
     * @param generation number of rotations of its credentials
     */
    public Login device(String mission, String device, int generation) {
        return deviceLogin(newest(), mission, device, generation);
    }

    /** Returns the accepted logins of a device, that of the newest key first. */
    public List<Login> devices(String mission, String device, int generation) {
        return accepted.stream()
                .map(key -> deviceLogin(key, mission, device, generation))
                .toList();
    }

    /** Returns the login of the gateway of all devices of a mission: user {@code furrow.m.<mission>.<key>}. */
    public Login gateway(String mission) {
        return gatewayLogin(newest(), mission);
    }

    /** Returns the accepted logins of a gateway, that of the newest key first. */
    public List<Login> gateways(String mission) {
        return accepted.stream().map(key -> gatewayLogin(key, mission)).toList();
    }

    private static Login deviceLogin(FarmKey key, String mission, String device, int generation) {
        return login(key, String.join(".", "d", encode(mission), encode(device), "" + key.number(), "" + generation));
    }

    private static Login gatewayLogin(FarmKey key, String mission) {
        return login(key, "m." + encode(mission) + "." + key.number());
    }

    /** Returns the login of a user by a key that is no longer accepted; empty if the secret has none of this number. */
    public Optional<Login> expired(String user, int number) {
        return keys.stream()
                .filter(key -> key.number() == number && !accepted.contains(key))
                .map(key -> new Login(user, key.code("password", user)))
                .findFirst();
    }

    private static Login login(FarmKey key, String name) {
        String user = USER_PREFIX + name;
        return new Login(user, key.code("password", user));
    }

    /** Returns the device of a user, for any key and generation; empty for all other users. */
    public static Optional<String> deviceOf(String user) {
        String[] parts = user.split("\\.", -1);
        return parts.length == 6 && user.startsWith(USER_PREFIX + "d.") ? decode(parts[3]) : Optional.empty();
    }

    /** Returns the mission of a gateway's user, for any key; empty for all other users. */
    public static Optional<String> missionOf(String user) {
        String[] parts = user.split("\\.", -1);
        return parts.length == 4 && user.startsWith(USER_PREFIX + "m.") ? decode(parts[2]) : Optional.empty();
    }

    private static Optional<String> decode(String name) {
        try {
            return Optional.of(URLDecoder.decode(name, StandardCharsets.UTF_8));
        } catch (IllegalArgumentException e) { // not a name of Furrow; clients may try any user
            return Optional.empty();
        }
    }

    /** Encodes special characters of files and topics of MQTT brokers, and the dot between the parts of a user. */
    private static String encode(String name) {
        return URLEncoder.encode(name, StandardCharsets.UTF_8)
                .replace("+", "%20")
                .replace(".", "%2E")
                .replace("*", "%2A");
    }

    /**
     * The public description of a key.
     *
     * @param fingerprint 16 hexadecimal digits that do not reveal the key
     * @param until when its passwords expire; null for the newest key
     * @param makesApiKeys whether it derives API keys
     */
    public record KeyInfo(int number, String fingerprint, Instant until, boolean makesApiKeys) {}

    /** Returns descriptions of its keys, the newest first. */
    public List<KeyInfo> describe() {
        return keys.stream()
                .map(key -> new KeyInfo(key.number(), key.fingerprint(), key.until(), key.equals(apiKeys)))
                .toList();
    }

    /** Returns the numbers of the keys whose passwords are accepted, the newest first. */
    public List<Integer> acceptedKeys() {
        return accepted.stream().map(FarmKey::number).toList();
    }

    /** Returns the number of the key that derives passwords, which each rotation increments. */
    public int newestKey() {
        return newest().number();
    }

    /** Returns the fingerprint of the newest key: 16 hexadecimal digits that do not reveal it. */
    public String fingerprint() {
        return newest().fingerprint();
    }

    FarmKey newest() {
        return keys.get(0);
    }

    /** Returns the keys, the newest first. */
    List<FarmKey> keys() {
        return keys;
    }

    /** Returns the key that derives API keys. */
    FarmKey apiKeys() {
        return apiKeys;
    }

    /** Returns whether the keys and the accepted keys are the same. */
    @Override
    public boolean equals(Object other) {
        return other instanceof FarmSecret that
                && keys.equals(that.keys)
                && apiKeys.equals(that.apiKeys)
                && accepted.equals(that.accepted);
    }

    @Override
    public int hashCode() {
        return Objects.hash(keys, apiKeys, accepted);
    }

    /** Returns the fingerprint and number of the newest key. */
    @Override
    public String toString() {
        return fingerprint() + " (key " + newestKey() + ")";
    }
}
