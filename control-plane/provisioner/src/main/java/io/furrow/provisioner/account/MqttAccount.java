package io.furrow.provisioner.account;

import java.util.ArrayList;
import java.util.List;

import io.furrow.model.device.FarmSecret;

/**
 * An account at the MQTT broker with its permissions. A device may publish its own measures and command results, and
 * subscribe to its own commands; a gateway may do so for all devices of its mission.
 *
 * @param login user and password
 * @param writes topic filters that it may publish to
 * @param reads topic filters that it may subscribe to
 */
public record MqttAccount(FarmSecret.Login login, List<String> writes, List<String> reads) {
    /** The IoT Agent accepts topics with and without the prefix. */
    private static final List<String> PREFIXES = List.of("", "/json");

    /** Returns the account of a device whose credentials were never rotated, with the newest key. */
    public static MqttAccount device(FarmSecret secret, String mission, String device) {
        return of(secret.device(mission, device), secret.apiKey(mission), device);
    }

    /** Returns the account of a mission's gateway with the newest key. */
    public static MqttAccount gateway(FarmSecret secret, String mission) {
        return of(secret.gateway(mission), secret.apiKey(mission), "+");
    }

    /** Returns one account for each accepted key. */
    public static List<MqttAccount> devices(FarmSecret secret, String mission, String device, int generation) {
        String apiKey = secret.apiKey(mission);
        return secret.devices(mission, device, generation).stream()
                .map(login -> of(login, apiKey, device))
                .toList();
    }

    /** Returns one account for each accepted key. */
    static List<MqttAccount> gateways(FarmSecret secret, String mission) {
        String apiKey = secret.apiKey(mission);
        return secret.gateways(mission).stream()
                .map(login -> of(login, apiKey, "+"))
                .toList();
    }

    private static MqttAccount of(FarmSecret.Login login, String apiKey, String device) {
        List<String> writes = new ArrayList<>();
        List<String> reads = new ArrayList<>();
        for (String prefix : PREFIXES) {
            String topic = prefix + "/" + apiKey + "/" + device + "/";
            writes.add(topic + "attrs");
            writes.add(topic + "cmdexe");
            reads.add(topic + "cmd");
        }
        return new MqttAccount(login, writes, reads);
    }

    public boolean mayWrite(String topic) {
        return writes.stream().anyMatch(granted -> covers(granted, topic));
    }

    /** @param filter of a subscription, with or without wildcards */
    public boolean mayRead(String filter) {
        return reads.stream().anyMatch(granted -> covers(granted, filter));
    }

    /** Whether the granted filter matches every topic that another filter matches. */
    private static boolean covers(String granted, String filter) {
        String[] filterLevels = filter.split("/", -1);
        String[] grantedLevels = granted.split("/", -1);
        if (filterLevels.length != grantedLevels.length) {
            return false;
        }
        for (int i = 0; i < grantedLevels.length; i++) {
            boolean any = grantedLevels[i].equals("+") && !filterLevels[i].equals("#");
            if (!any && !grantedLevels[i].equals(filterLevels[i])) {
                return false;
            }
        }
        return true;
    }
}
