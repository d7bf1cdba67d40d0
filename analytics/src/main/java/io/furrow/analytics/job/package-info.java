/** The common frame of the analytics jobs: options, and the connection of a job with its topics. */
package io.furrow.analytics.job;
