/** Which secret a farm has, agreed on over {@code service.secrets}, and how processes follow its rotation. */
package io.furrow.kafka.secret;
