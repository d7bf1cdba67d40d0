package io.furrow.provisioner.account;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.TimeUnit;
import java.util.function.BiPredicate;
import java.util.function.Predicate;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.FarmSecret;

/**
 * Writes accounts to sections of Mosquitto's password file and ACL file, if they have changed, and then runs a command
 * that makes the broker reload the files, at most once a second.
 */
public final class MosquittoFiles implements MqttAccounts {
    private static final Logger LOG = LoggerFactory.getLogger(MosquittoFiles.class);
    private static final long COMMAND_SECONDS = 10;
    private static final int MAX_OUTPUT = 1000;
    /** Mosquitto loses a signal that arrives while it reloads its files: 0.4 s with ten thousand accounts. */
    private static final long BETWEEN_RELOADS_NANOS = TimeUnit.SECONDS.toNanos(1);

    private static final Pattern USER_RULE = Pattern.compile("\\s*user\\s+(.*?)\\s*");

    private final ManagedFileSection passwords;
    private final ManagedFileSection rules;
    private final String reload;
    /** Lines that were created or verified, because a verification takes as long as a login. */
    private Map<FarmSecret.Login, String> verified = Map.of();

    private Map<String, String> reported = Map.of();
    /** True at the start: a crashed process may have written the files without notifying the broker. */
    private boolean reloadIsDue = true;

    private long reloaded = System.nanoTime() - BETWEEN_RELOADS_NANOS;

    /**
     * @param passwords option {@code password_file} of the broker
     * @param rules option {@code acl_file} of the broker
     * @param reload command for {@code sh -c}, as in {@code kill -HUP $(cat /run/mosquitto/mosquitto.pid)}; null for
     *     none. Messages do not contain it, because it may contain a password
     */
    public MosquittoFiles(Path passwords, Path rules, String reload) {
        this.passwords = new ManagedFileSection(passwords);
        this.rules = new ManagedFileSection(rules);
        this.reload = reload;
    }

    @Override
    public synchronized Map<String, String> replace(List<MqttAccount> accounts, Set<String> retained)
            throws IOException {
        List<String> before = passwords.read();
        Map<String, String> rejected = rejected(accounts, SectionComments.of(before));
        List<MqttAccount> own = accounts.stream()
                .filter(account -> !rejected.containsKey(account.login().user()))
                .toList();
        Set<String> users = own.stream().map(account -> account.login().user()).collect(Collectors.toSet());
        Predicate<String> retain = user -> retained.contains(user) && !users.contains(user);
        List<String> nextRules = rulesOf(retain);
        nextRules.addAll(rules(own));
        List<String> next = passwordsOf(before, retain);
        next.addAll(passwords(own));
        // Rules before passwords: if only one file is written, no user can log in without rules.
        reloadIsDue |= write(rules, nextRules);
        reloadIsDue |= write(passwords, SectionComments.of(before).with(users).linesBefore(next));
        reloadIfDue();
        return rejected;
    }

    /** Rejects users that exist outside of the section: of two lines Mosquitto would use the later one. */
    private Map<String, String> rejected(List<MqttAccount> accounts, SectionComments comments) throws IOException {
        Set<String> users = new HashSet<>();
        accounts.forEach(account -> users.add(account.login().user()));
        Map<String, String> rejected = new TreeMap<>();
        users.forEach(user -> comments.rejection(user).ifPresent(reason -> rejected.put(user, reason)));
        for (String line : passwords.readOthers()) {
            reject(MosquittoPassword.user(line), passwords, users, rejected);
        }
        for (String line : rules.readOthers()) {
            reject(user(line), rules, users, rejected);
        }
        if (!rejected.isEmpty() && !rejected.equals(reported)) {
            rejected.values().forEach(LOG::warn);
        }
        reported = rejected;
        return rejected;
    }

    private static void reject(String user, ManagedFileSection file, Set<String> users, Map<String, String> rejected) {
        if (users.contains(user)) {
            rejected.put(
                    user,
                    "user '%s' exists outside of Furrow's section of %s and is not replaced; remove it there"
                            .formatted(user, file));
        }
    }

    @Override
    public synchronized Set<String> retain(
            Set<String> users, BiPredicate<String, Predicate<FarmSecret.Login>> removable) throws IOException {
        List<String> before = passwords.read();
        Map<String, String> lines = byUser(before);
        Map<String, Integer> desired = new HashMap<>();
        users.stream().map(UserName::of).forEach(name -> desired.merge(name.owner(), name.generation(), Math::max));
        Predicate<String> retain = user -> {
            UserName name = UserName.of(user);
            boolean later = name.generation() > desired.getOrDefault(name.owner(), Integer.MAX_VALUE);
            return users.contains(user) || later || !removable.test(user, login -> isOf(lines.get(user), login));
        };
        List<String> next = passwordsOf(before, retain);
        List<String> nextRules = rulesOf(retain);
        // Passwords before rules: if only one file is written, revoked users cannot log in.
        reloadIsDue |= write(passwords, SectionComments.of(before).with(users).linesBefore(next));
        reloadIsDue |= write(rules, nextRules);
        reloadIfDue();
        return next.stream()
                .map(MosquittoPassword::user)
                .filter(user -> !users.contains(user))
                .collect(Collectors.toSet());
    }

    /** Whether a line is of a login; without a line, as after a crash, nobody can log in by the rules that are left. */
    private static boolean isOf(String line, FarmSecret.Login login) {
        return line == null || MosquittoPassword.isOf(line, login);
    }

    private static Map<String, String> byUser(List<String> lines) {
        Map<String, String> byUser = new HashMap<>();
        lines.forEach(line -> byUser.put(MosquittoPassword.user(line), line));
        return byUser;
    }

    private static List<String> passwordsOf(List<String> lines, Predicate<String> users) {
        return lines.stream()
                .filter(line -> !SectionComments.isComment(line) && users.test(MosquittoPassword.user(line)))
                .collect(Collectors.toCollection(ArrayList::new));
    }

    private List<String> rulesOf(Predicate<String> users) throws IOException {
        List<String> lines = new ArrayList<>();
        boolean retained = false;
        for (String line : rules.read()) {
            String user = user(line);
            retained = user == null ? retained : users.test(user);
            if (retained) {
                lines.add(line);
            }
        }
        return lines;
    }

    @Override
    public synchronized Optional<String> origin() throws IOException {
        return SectionComments.of(passwords.read()).origin();
    }

    @Override
    public synchronized void recordOrigin(String topic) throws IOException {
        List<String> before = passwords.read();
        write(passwords, SectionComments.of(before).with(topic).linesBefore(passwordsOf(before, any -> true)));
    }

    /** Returns the user of a {@code user} line of the rules; null for other lines. */
    private static String user(String rule) {
        Matcher user = USER_RULE.matcher(rule);
        return user.matches() ? user.group(1) : null;
    }

    private void reloadIfDue() throws IOException {
        if (reloadIsDue && reload != null) {
            reload();
        }
        reloadIsDue = false;
    }

    private static boolean write(ManagedFileSection section, List<String> lines) throws IOException {
        if (section.read().equals(lines)) {
            return false;
        }
        section.write(lines);
        return true;
    }

    /** Reuses existing lines that match, because each new line has another salt. */
    private List<String> passwords(List<MqttAccount> accounts) throws IOException {
        Map<String, String> existing = byUser(passwords.read());
        Map<FarmSecret.Login, String> next = new LinkedHashMap<>();
        for (MqttAccount account : accounts) {
            FarmSecret.Login login = account.login();
            String line = existing.getOrDefault(login.user(), "");
            boolean retain = line.equals(verified.get(login)) || MosquittoPassword.isOf(line, login);
            next.put(login, retain ? line : MosquittoPassword.line(login));
        }
        verified = next;
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
        awaitLastReload();
        // A file, because a command that fills a pipe waits for a reader.
        Path output = Files.createTempFile("furrow-mqtt-reload", ".out");
        try {
            reload(output);
        } finally {
            Files.delete(output);
        }
        reloaded = System.nanoTime();
        LOG.debug("the MQTT broker reloads its files");
    }

    private void reload(Path output) throws IOException {
        Process process = new ProcessBuilder("sh", "-c", reload)
                .redirectErrorStream(true)
                .redirectOutput(output.toFile())
                .start();
        process.getOutputStream().close();
        try {
            if (!process.waitFor(COMMAND_SECONDS, TimeUnit.SECONDS)) {
                process.destroyForcibly();
                throw new IOException(
                        "the command of --mqtt-reload has not ended within %d s".formatted(COMMAND_SECONDS));
            }
        } catch (InterruptedException e) {
            process.destroyForcibly();
            Thread.currentThread().interrupt();
            throw new IOException("interrupted while the command of --mqtt-reload ran", e);
        }
        if (process.exitValue() != 0) {
            try (InputStream commandOutput = Files.newInputStream(output)) {
                throw new IOException("the command of --mqtt-reload ended with %d: %s"
                        .formatted(
                                process.exitValue(),
                                new String(commandOutput.readNBytes(MAX_OUTPUT), StandardCharsets.UTF_8).strip()));
            }
        }
    }

    private void awaitLastReload() throws IOException {
        try {
            TimeUnit.NANOSECONDS.sleep(reloaded + BETWEEN_RELOADS_NANOS - System.nanoTime());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IOException("interrupted before the command of --mqtt-reload ran", e);
        }
    }
}
