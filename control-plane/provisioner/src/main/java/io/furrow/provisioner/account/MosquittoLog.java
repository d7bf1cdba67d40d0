package io.furrow.provisioner.account;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Instant;
import java.time.LocalDateTime;
import java.time.ZoneId;
import java.time.format.DateTimeParseException;
import java.util.Map;
import java.util.function.LongSupplier;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.BoundedMap;
import io.furrow.model.device.FarmSecret;

/**
 * Extracts connections ({@code log_type notice}) and denied messages ({@code log_type debug}) from Mosquitto's log. For
 * a refused login Mosquitto 2.0 logs neither user nor client.
 *
 * <p>A client controls parts of lines, because it chooses its id and topics. An id is matched up to the last text that
 * could end it, so that no client can impersonate another; ambiguous lines are skipped.
 */
public final class MosquittoLog implements LoginReports {
    private static final Logger LOG = LoggerFactory.getLogger(MosquittoLog.class);
    private static final int MAX_CLIENTS = 100_000;
    private static final int MAX_ID = 256;
    /** The prefix follows {@code log_timestamp_format}, by default seconds; missing with {@code log_timestamp false}. */
    private static final String TIME = "(?:([^ ]+(?: [\\d:.]+)?): )?";

    private static final Pattern CONNECTED =
            Pattern.compile(TIME + "New client connected from [^ ]+ as (.*) \\(p\\d+, c\\d, k\\d+, u'([^']*)'\\)\\.");
    private static final Pattern DENIED = Pattern.compile(
            TIME + "Denied PUBLISH from (.*) \\(d\\d, q\\d, r\\d, m\\d+, '(.*)', \\.\\.\\. \\(\\d+ bytes\\)\\)");
    private static final Pattern SECONDS = Pattern.compile("\\d{1,12}");

    private final LogTail tail;
    private final LongSupplier clock;
    private final LoginHistory users = new LoginHistory(MAX_CLIENTS);
    private final Map<String, String> userByClient = BoundedMap.byAccess(MAX_CLIENTS);
    private String failure = "";

    /** @param file of option {@code log_dest file}; it need not exist yet */
    public MosquittoLog(Path file) {
        this(file, System::currentTimeMillis);
    }

    /** @param clock epoch ms */
    MosquittoLog(Path file, LongSupplier clock) {
        this.tail = new LogTail(file);
        this.clock = clock;
    }

    @Override
    public synchronized Map<String, LoginReport> reports() {
        try {
            tail.read(this::take);
            failure = "";
        } catch (IOException e) { // for instance missing permissions; earlier reports stay valid
            if (!e.toString().equals(failure)) {
                failure = e.toString();
                LOG.warn("Mosquitto's log cannot be read, so it is not known which devices connect: {}", failure);
            }
        }
        return users.reports();
    }

    private void take(String line) {
        Matcher connected = CONNECTED.matcher(line);
        if (connected.matches()
                && isOurs(connected.group(3))
                && connected.group(2).length() <= MAX_ID) {
            userByClient.put(connected.group(2), connected.group(3));
            users.loggedIn(connected.group(3), time(connected.group(1)));
            return;
        }
        Matcher denied = DENIED.matcher(line);
        String user = denied.matches() ? userByClient.get(denied.group(2)) : null;
        if (user != null) {
            users.published(user, denied.group(3), time(denied.group(1)));
        }
    }

    private static boolean isOurs(String user) {
        return user.startsWith(FarmSecret.USER_PREFIX);
    }

    private long time(String written) {
        if (written == null) {
            return clock.getAsLong();
        }
        if (SECONDS.matcher(written).matches()) {
            return Instant.ofEpochSecond(Long.parseLong(written)).toEpochMilli();
        }
        try {
            return LocalDateTime.parse(written.replace(' ', 'T'))
                    .atZone(ZoneId.systemDefault())
                    .toInstant()
                    .toEpochMilli();
        } catch (DateTimeParseException e) { // another format: the time of reading is close
            return clock.getAsLong();
        }
    }
}
