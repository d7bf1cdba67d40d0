package io.furrow.provisioner.account;

import java.util.Map;

/** Reports the logins at an MQTT broker. Thread-safe. */
public interface LoginReports {
    /** Returns the reports by user: of all users with an account, and of the newest users without. */
    Map<String, LoginReport> reports();
}
