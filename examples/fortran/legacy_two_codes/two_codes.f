C SPDX-License-Identifier: BSD-3-Clause
C
C Two codes in one MPI program, in the style of old Fortran. Half of the
C ranks solve the heat equation in a round plate on nodes from PNPBS and
C find at which rate the plate cools. Meanwhile the other half, who know
C nothing of PNPBS, find what the rate must be: the square of the first
C zero of Bessel's function J0. At the end the codes swap their results.
C Alone, a rank does one after the other.
C
C Usage: two_codes [FOLDER]   with a folder, the heat code's ranks write
C                             the pieces of a picture into it
      PROGRAM TWOCOD
      INCLUDE 'mpif.h'
      INTEGER NSIZE, MYRANK, NHEAT, MYCODE, MYCOMM, IERR
      INTEGER ISTAT(MPI_STATUS_SIZE)
      DOUBLE PRECISION RATE(1), ZERO(1), APART
      INTEGER*8 NNODES
      CHARACTER*200 FOLDER

      CALL MPI_INIT(IERR)
      CALL MPI_COMM_SIZE(MPI_COMM_WORLD, NSIZE, IERR)
      CALL MPI_COMM_RANK(MPI_COMM_WORLD, MYRANK, IERR)
      CALL GETARG(1, FOLDER)

C     The first NHEAT ranks are the heat code, the others Bessel's.
      NHEAT = (NSIZE + 1) / 2
      MYCODE = 0
      IF (MYRANK .GE. NHEAT) MYCODE = 1
      CALL MPI_COMM_SPLIT(MPI_COMM_WORLD, MYCODE, MYRANK, MYCOMM, IERR)
      IF (MYCODE .EQ. 0) CALL HEAT(MYCOMM, FOLDER, NNODES, RATE(1))
      IF (MYCODE .EQ. 1 .OR. NSIZE .EQ. 1) CALL BESSEL(MYCOMM, ZERO(1))

C     The first rank of each code swaps results with that of the other.
      IF (NSIZE .GT. 1 .AND. MYRANK .EQ. 0) THEN
        CALL MPI_SENDRECV(RATE, 1, MPI_DOUBLE_PRECISION, NHEAT, 1,
     &                    ZERO, 1, MPI_DOUBLE_PRECISION, NHEAT, 2,
     &                    MPI_COMM_WORLD, ISTAT, IERR)
      ELSE IF (NSIZE .GT. 1 .AND. MYRANK .EQ. NHEAT) THEN
        CALL MPI_SENDRECV(ZERO, 1, MPI_DOUBLE_PRECISION, 0, 2,
     &                    RATE, 1, MPI_DOUBLE_PRECISION, 0, 1,
     &                    MPI_COMM_WORLD, ISTAT, IERR)
      END IF

      IF (MYRANK .EQ. 0) THEN
        APART = 100D0 * ABS(RATE(1) / ZERO(1)**2 - 1D0)
        WRITE (*, 100) NNODES
        WRITE (*, 101) ZERO(1)
        WRITE (*, 102) RATE(1), ZERO(1)**2
        WRITE (*, 103) APART
      END IF
  100 FORMAT ('nodes: ', I4, ', expected about 1494')
  101 FORMAT ('first zero of J0: ', F7.5, ', expected 2.40483')
  102 FORMAT ('rate at which the plate cools: ', F6.4,
     &        ', expected about ', F6.4)
  103 FORMAT ('percent by which they differ: ', F4.2,
     &        ', expected at most 0.50')

      CALL MPI_COMM_FREE(MYCOMM, IERR)
      CALL MPI_FINALIZE(IERR)
      END
