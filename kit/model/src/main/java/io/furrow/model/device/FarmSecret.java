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
 * The one secret of a farm, of which the API key of each mission and the MQTT password of each device are made: the control plane,
 * which provisions devices, and their host come to the same without a password on any topic. Whoever has the secret has all of
 * them.
 *
 * <p>It has one key or, after a rotation, several. The newest makes passwords; those of older keys are accepted until a time that
 * each of them has. API keys are addresses, a part of MQTT topics: one key continues making them through rotations.
 */
public final class FarmSecret {
    /** What the names of all its MQTT users begin with. */
    public static final String USER_PREFIX = "furrow.";

    private static final int GENERATED_BYTES = 32;

    private final List<FarmKey> keys;
    private final FarmKey apiKeys;
    private final List<FarmKey> accepted;

    /** User and password at the MQTT broker; the password is left out of {@link #toString()}. */
    public record Login(String user, String password) {
        @Override
        public String toString() {
            return user;
        }
    }

    /**
     * A secret with one key.
     *
     * @throws IllegalArgumentException where there are fewer than 16 bytes
     */
    public FarmSecret(byte[] secret) {
        this(new FarmKey(1, new String(secret, StandardCharsets.UTF_8), null));
    }

    private FarmSecret(FarmKey only) {
        this(List.of(only), only);
    }

    /** @param apiKeys the one of them that makes API keys */
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

    /** A secret with one key of 256 random bits. */
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
     * The same with a new key that makes passwords from now on.
     *
     * @param now keys whose time was over by then are left out, but that which makes API keys
     * @param until when passwords of the key that was the newest cease to count
     * @param newApiKeys whether the new key makes API keys too; the others then only recognize those derived from them
     */
    public FarmSecret rotated(Instant now, Instant until, boolean newApiKeys) {
        FarmKey fresh = random(newest().number() + 1);
        List<FarmKey> next = new ArrayList<>(List.of(fresh));
        for (FarmKey key : keys) {
            // The one before stays in any case: by it the farm knows that this secret comes after its own.
            if (key.until() == null) {
                next.add(key.endingAt(until));
            } else if (key.isAcceptedAt(now) || key.equals(apiKeys)) {
                next.add(key);
            }
        }
        int naming = newApiKeys ? fresh.number() : apiKeys.number();
        return new FarmSecret(
                next,
                next.stream().filter(key -> key.number() == naming).findFirst().orElseThrow());
    }

    /** The same as it is at a time: logins are those of the keys that are accepted then. */
    public FarmSecret at(Instant time) {
        List<FarmKey> then = keys.stream().filter(key -> key.isAcceptedAt(time)).toList();
        return then.equals(accepted) ? this : new FarmSecret(keys, apiKeys, then);
    }

    /** The first part of a mission's MQTT topics, {@code /<apikey>/<device>/attrs}: 22 of {@code A-Za-z0-9_-}. */
    public String apiKey(String mission) {
        return apiKey(apiKeys, mission);
    }

    /** Whether an API key was made for a mission of any key of this secret. */
    public boolean madeApiKey(String apiKey, String mission) {
        return keys.stream().anyMatch(key -> apiKey(key, mission).equals(apiKey));
    }

    private static String apiKey(FarmKey key, String mission) {
        return key.code("apikey", mission, "");
    }

    /** The login of a device whose credentials were never rotated. */
    public Login device(String mission, String device) {
        return device(mission, device, 0);
    }

    /**
     * The login of a device, of the newest key: user {@code furrow.d.<mission>.<device>.<key>.<generation>}, mission and device with
     * all but {@code A-Za-z0-9_-} percent-encoded, so that no two logins share a user.
     *
     * @param device its id at the IoT Agent
     * @param generation how often its credentials were rotated
     */
    public Login device(String mission, String device, int generation) {
        return deviceLogin(newest(), mission, device, generation);
    }

    /** The logins of a device that are accepted, that of the newest key first. */
    public List<Login> devices(String mission, String device, int generation) {
        return accepted.stream()
                .map(key -> deviceLogin(key, mission, device, generation))
                .toList();
    }

    /** The login of the gateway that speaks for all devices of a mission: user {@code furrow.m.<mission>.<key>}. */
    public Login gateway(String mission) {
        return gatewayLogin(newest(), mission);
    }

    /** The logins of a gateway that are accepted, that of the newest key first. */
    public List<Login> gateways(String mission) {
        return accepted.stream().map(key -> gatewayLogin(key, mission)).toList();
    }

    private static Login deviceLogin(FarmKey key, String mission, String device, int generation) {
        return login(key, String.join(".", "d", encoded(mission), encoded(device), "" + key.number(), "" + generation));
    }

    private static Login gatewayLogin(FarmKey key, String mission) {
        return login(key, "m." + encoded(mission) + "." + key.number());
    }

    private static Login login(FarmKey key, String name) {
        String user = USER_PREFIX + name;
        return new Login(user, key.code("password", user));
    }

    /** The device of which a user is the login, of whatever key and generation; empty for all other users. */
    public static Optional<String> deviceOf(String user) {
        String[] parts = user.split("\\.", -1);
        return parts.length == 6 && user.startsWith(USER_PREFIX + "d.") ? decoded(parts[3]) : Optional.empty();
    }

    /** The mission of which a user is the gateway's login, of whatever key; empty for all other users. */
    public static Optional<String> missionOf(String user) {
        String[] parts = user.split("\\.", -1);
        return parts.length == 4 && user.startsWith(USER_PREFIX + "m.") ? decoded(parts[2]) : Optional.empty();
    }

    private static Optional<String> decoded(String name) {
        try {
            return Optional.of(URLDecoder.decode(name, StandardCharsets.UTF_8));
        } catch (IllegalArgumentException e) { // no name of ours: anybody can try to log in with any
            return Optional.empty();
        }
    }

    /** Without the signs that mean something in files or topics of an MQTT broker, and without the dot between the parts of a user. */
    private static String encoded(String name) {
        return URLEncoder.encode(name, StandardCharsets.UTF_8)
                .replace("+", "%20")
                .replace(".", "%2E")
                .replace("*", "%2A");
    }

    /**
     * What may be shown of a key.
     *
     * @param fingerprint 16 hexadecimal digits that reveal nothing of it
     * @param until when its passwords cease to count; null for the newest key
     * @param makesApiKeys whether it makes API keys
     */
    public record KeyInfo(int number, String fingerprint, Instant until, boolean makesApiKeys) {}

    /** Its keys, the newest first. */
    public List<KeyInfo> describe() {
        return keys.stream()
                .map(key -> new KeyInfo(key.number(), key.fingerprint(), key.until(), key.equals(apiKeys)))
                .toList();
    }

    /** Numbers of the keys whose passwords are accepted, the newest first. */
    public List<Integer> acceptedKeys() {
        return accepted.stream().map(FarmKey::number).toList();
    }

    /** Number of the key that makes passwords; a rotation gives the next. */
    public int newestKey() {
        return newest().number();
    }

    /** Of the newest key: 16 hexadecimal digits that reveal nothing of it. */
    public String fingerprint() {
        return newest().fingerprint();
    }

    FarmKey newest() {
        return keys.get(0);
    }

    /** The newest first. */
    List<FarmKey> keys() {
        return keys;
    }

    /** The one that makes API keys. */
    FarmKey apiKeys() {
        return apiKeys;
    }

    /** Whether all keys are the same and the same of them are accepted. */
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

    /** Fingerprint and number of the newest key. */
    @Override
    public String toString() {
        return fingerprint() + " (key " + newestKey() + ")";
    }
}
