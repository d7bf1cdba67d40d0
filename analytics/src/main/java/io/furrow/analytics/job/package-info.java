/** The frame of the analytics jobs: common options, and how a job is put between its topics. */
package io.furrow.analytics.job;
