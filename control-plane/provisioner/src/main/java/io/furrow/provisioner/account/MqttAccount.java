package io.furrow.provisioner.account;

import java.util.ArrayList;
import java.util.List;

import io.furrow.model.device.FarmSecret;

/**
 * Who may do what at the MQTT broker. A device may publish its own measures and results of commands, and hear its own commands; a
 * gateway may the same for all devices of its mission.
 *
 * @param login user and password
 * @param writes topic filters that it may publish to
 * @param reads topic filters that it may subscribe to
 */
public record MqttAccount(FarmSecret.Login login, List<String> writes, List<String> reads) {
    /** The IoT Agent takes topics with either. */
    private static final List<String> PREFIXES = List.of("", "/json");

    /** Of a device whose credentials were never rotated, with the newest key. */
    public static MqttAccount device(FarmSecret secret, String mission, String device) {
        return of(secret.device(mission, device), secret.apiKey(mission), device);
    }

    /** With the newest key. */
    public static MqttAccount gateway(FarmSecret secret, String mission) {
        return of(secret.gateway(mission), secret.apiKey(mission), "+");
    }

    /** One for each key that is accepted. */
    public static List<MqttAccount> devices(FarmSecret secret, String mission, String device, int generation) {
        String apiKey = secret.apiKey(mission);
        return secret.devices(mission, device, generation).stream()
                .map(login -> of(login, apiKey, device))
                .toList();
    }

    /** One for each key that is accepted. */
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

    /** @param filter of a subscription, with wildcards or without */
    public boolean mayRead(String filter) {
        return reads.stream().anyMatch(granted -> covers(granted, filter));
    }

    /** Whether a filter takes no topic that the granted one does not. */
    private static boolean covers(String granted, String filter) {
        String[] desired = filter.split("/", -1);
        String[] given = granted.split("/", -1);
        if (desired.length != given.length) {
            return false;
        }
        for (int i = 0; i < given.length; i++) {
            boolean any = given[i].equals("+") && !desired[i].equals("#");
            if (!any && !given[i].equals(desired[i])) {
                return false;
            }
        }
        return true;
    }
}
