package io.furrow.control.provisioning;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.FarmSecret;

/**
 * Accounts as a section of Mosquitto's password file and of its ACL file. Where nothing changes nothing is written. After a
 * change a command lets the broker read them again.
 */
public final class MosquittoFiles implements MqttAccounts {
    private static final Logger LOG = LoggerFactory.getLogger(MosquittoFiles.class);
    private static final long COMMAND_SECONDS = 10;

    private final OwnSection passwords;
    private final OwnSection rules;
    private final String reload;
    /** What was made or checked already, because a check takes as long as a login. */
    private Map<FarmSecret.Login, String> checked = Map.of();

    private boolean reloadIsDue;

    /**
     * @param passwords option {@code password_file} of the broker
     * @param rules option {@code acl_file} of the broker
     * @param reload for {@code sh -c}, as in {@code kill -HUP $(cat /run/mosquitto.pid)}; null for none
     */
    public MosquittoFiles(Path passwords, Path rules, String reload) {
        this.passwords = new OwnSection(passwords);
        this.rules = new OwnSection(rules);
        this.reload = reload;
    }

    @Override
    public synchronized void replace(List<MqttAccount> accounts) throws IOException {
        // The rules first: should only one of both be written, nobody gets in without them.
        reloadIsDue |= write(rules, rules(accounts));
        reloadIsDue |= write(passwords, passwords(accounts));
        if (reloadIsDue && reload != null) {
            reload();
        }
        reloadIsDue = false;
    }

    private static boolean write(OwnSection section, List<String> lines) throws IOException {
        if (section.read().equals(lines)) {
            return false;
        }
        section.write(lines);
        return true;
    }

    /** Lines that are right already stay as they are; a new one has another salt each time. */
    private List<String> passwords(List<MqttAccount> accounts) throws IOException {
        Map<String, String> known = new HashMap<>();
        passwords.read().forEach(line -> known.put(MosquittoPassword.user(line), line));
        Map<FarmSecret.Login, String> next = new LinkedHashMap<>();
        for (MqttAccount account : accounts) {
            FarmSecret.Login login = account.login();
            String line = known.getOrDefault(login.user(), "");
            boolean stays = line.equals(checked.get(login)) || MosquittoPassword.isOf(line, login);
            next.put(login, stays ? line : MosquittoPassword.line(login));
        }
        checked = next;
        return List.copyOf(next.values());
    }

    private static List<String> rules(List<MqttAccount> accounts) {
        List<String> lines = new ArrayList<>();
        for (MqttAccount account : accounts) {
            lines.add("user " + account.login().user());
            account.writes().forEach(topic -> lines.add("topic write " + topic));
            account.reads().forEach(topic -> lines.add("topic read " + topic));
        }
        return lines;
    }

    private void reload() throws IOException {
        Process process = new ProcessBuilder("sh", "-c", reload)
                .redirectErrorStream(true)
                .redirectOutput(ProcessBuilder.Redirect.PIPE)
                .start();
        process.getOutputStream().close();
        try {
            if (!process.waitFor(COMMAND_SECONDS, TimeUnit.SECONDS)) {
                process.destroyForcibly();
                throw new IOException("'%s' has not ended within %d s".formatted(reload, COMMAND_SECONDS));
            }
        } catch (InterruptedException e) {
            process.destroyForcibly();
            Thread.currentThread().interrupt();
            throw new IOException("interrupted while '" + reload + "' ran", e);
        }
        if (process.exitValue() != 0) {
            String said = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
            throw new IOException("'%s' ended with %d: %s".formatted(reload, process.exitValue(), said.strip()));
        }
        LOG.debug("the MQTT broker was told to read its files again");
    }
}
